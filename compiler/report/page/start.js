set_up_redrawing();
if (data.pareto) set_up_pareto(data.pareto.figures, data.pareto.candidates);
if (data.live) set_up_live(data.live);
