// The error of what is felt over frequency, a curve for each candidate.
function set_up_felt_error({ frequencies, candidates }) {
  const holder = element('felt-error');
  const hidden = new Set();  // names; what was hidden stays so when the chart is drawn anew
  const shown_value = (u, v) => (v === null || v === undefined ? '' : `${rounded(v)} %`);
  const curve = ({ name, chosen }, i) => ({
    label: name, show: !hidden.has(name), width: chosen ? 3 : 1.5, points: { show: false }, value: shown_value,
    stroke: chosen ? colour('--ink') : `hsl(${Math.round((360 * i) / candidates.length + 20)} 60% 50%)` });
  let chart = null;

  function draw() {
    const width = width_of(holder);
    chart?.destroy();
    holder.replaceChildren();
    chart = new uPlot({
      width, height: Math.round(Math.min(360, 140 + width * 0.45)), padding: [12, 20, 0, 0], legend: { show: true, live: true },
      scales: { x: { time: false, distr: 3, range: [frequencies[0], frequencies[frequencies.length - 1]] }, y: { distr: 3 } },
      axes: [axis('frequency [Hz]'), axis('felt error [%]', { ...numbers_wide, space: 30 })],
      series: [{ label: 'frequency', value: (u, v) => (v === null || v === undefined ? '' : `${rounded(v)} Hz`) },
               ...candidates.map(curve)],
      hooks: { ...quiet_legend, setSeries: [(u, i, options) => remember(i, options)] },
    }, [frequencies, ...candidates.map(({ errors }) => errors.map((error) => (error > 0 ? error : null)))], holder);
  }

  function remember(i, { show }) {
    if (i === null || show === undefined) return;
    hidden[show ? 'delete' : 'add'](candidates[i - 1].name);
  }

  drawings.push(draw);
  draw();
}
