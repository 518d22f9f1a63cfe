set_up_redrawing();
set_up_scroll_cues();
if (data.pareto) set_up_pareto(data.pareto.figures, data.pareto.candidates);
if (data.felt_error) set_up_felt_error(data.felt_error);
if (data.live) set_up_live(data.live);
if (data.drag) set_up_drag(data.drag);
