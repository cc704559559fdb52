'use strict';
// Draws every figure of the page from the numbers in #report-data (figures.hpp has their units).
// Colour means phase everywhere; dashes and open marks say the same to readers who do not see the colour.
(() => {
  const dashes = ['dash', 'solid', 'dashdot', 'dot'];
  const phaseMarks = ['circle-open', 'circle', 'square', 'triangle-up'];
  const marks = { cw: ['circle-open', 'circle', 'circle', 'circle'], ccw: ['diamond-open', 'diamond', 'diamond', 'diamond'] };
  const names = { cw: 'clockwise', ccw: 'counter-clockwise' };
  // Without a mouse, dragging must scroll the page and there is nothing to hover with.
  const touch = !matchMedia('(hover: hover) and (pointer: fine)').matches;
  const config = {
    displaylogo: false,
    displayModeBar: touch ? false : 'hover',
    modeBarButtons: [['toImage', 'zoom2d', 'pan2d', 'zoomIn2d', 'zoomOut2d', 'resetScale2d']],  // none that uploads
  };

  const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const phaseColour = (phase) => style(`--phase-${phase % 4}`);
  // The library reads a little HTML in its labels; text from a recording must not become any.
  const label = (text) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;');
  const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);
  const phaseName = (data, phase) => label(capital(data.phases[phase]));
  const largest = (values) => values.reduce((most, v) => (v === null ? most : Math.max(most, Math.abs(v))), 0);
  const extent = (values) => values.reduce(([lo, hi], v) => (v === null ? [lo, hi] : [Math.min(lo, v), Math.max(hi, v)]), [Infinity, -Infinity]);
  const padded = ([lo, hi], least) => {
    const half = Math.max((hi - lo) / 2 * 1.08, least);
    return [(lo + hi) / 2 - half, (lo + hi) / 2 + half];
  };

  const axis = (title, more) => ({
    title: { text: title, standoff: 6 }, gridcolor: style('--grid'), zerolinecolor: style('--line'), zerolinewidth: 1.5,
    linecolor: style('--line'), tickcolor: style('--line'), automargin: true, fixedrange: touch, ...more,
  });
  const layout = (more) => ({
    autosize: false, margin: { l: 56, r: 12, t: 30, b: 44 }, paper_bgcolor: 'rgba(0,0,0,0)', plot_bgcolor: 'rgba(0,0,0,0)',
    font: { family: getComputedStyle(document.body).fontFamily, size: 12.5, color: style('--ink') },
    hoverlabel: { bgcolor: style('--raised'), bordercolor: style('--line'), font: { color: style('--ink') } },
    legend: { orientation: 'h', x: 0, y: 1, xanchor: 'left', yanchor: 'bottom', font: { size: 12 } },
    modebar: { bgcolor: 'rgba(0,0,0,0)', color: style('--muted'), activecolor: style('--ink') },
    dragmode: touch ? false : 'zoom', ...more,
  });

  // On paper a group of runs fits one page: two paths beside one another over the errors, or four of them, smaller.
  const onPaper = () => document.documentElement.hasAttribute('data-printing');
  const heightOnPaper = (group, kind) => (group.phases.length > 2 ? { path: 250, errors: 330 } : { path: 330, errors: 430 })[kind];

  // Each drawing takes the figure's dataset and the width it has, and returns what to plot and how high.
  const drawings = {
    merit(data) {
      const phases = [...new Set(data.clusters.map((c) => c.phase))];
      const traces = phases.map((phase) => {
        const clusters = data.clusters.filter((c) => c.phase === phase);
        return {
          type: 'scatter', mode: 'markers', name: phaseName(data, phase),
          x: clusters.map((c) => c.r), y: clusters.map((c) => capital(names[c.direction])),
          error_x: { type: 'data', array: clusters.map((c) => c.se_r), color: phaseColour(phase), thickness: 1.5 },
          marker: { symbol: phaseMarks[phase % 4], size: 11, color: phaseColour(phase), line: { width: 2, color: phaseColour(phase) } },
          hovertemplate: '%{y}: %{x:.1f} mm',
        };
      });
      const most = largest(data.clusters.map((c) => c.r + (c.se_r ?? 0)));
      return [traces, layout({
        xaxis: axis('r<sub>cg</sub> in mm', { range: [-0.03 * most, most * 1.06 || 1] }),
        yaxis: axis('', { range: [1.6, -0.6], fixedrange: true, zeroline: false }),
      }), 230];
    },

    scatter(data, figure, width) {
      const phase = Number(figure.phase);
      const shown = document.querySelector('[data-scale] input:checked').value === 'same' ? data.clusters : data.clusters.filter((c) => c.phase === phase);
      const reach = largest(shown.flatMap((c) => [...c.x, ...c.y, c.r])) * 1.08 || 1;
      const colour = phaseColour(phase);
      const turn = Array.from({ length: 181 }, (_, i) => i * Math.PI / 90);
      const traces = data.clusters.filter((c) => c.phase === phase).flatMap((c) => {
        const mark = { symbol: marks[c.direction][phase % 4], color: colour };
        return [
          { name: `r<sub>cg</sub> ${names[c.direction]}`, mode: 'lines', x: turn.map((a) => c.r * Math.cos(a)), y: turn.map((a) => c.r * Math.sin(a)),
            line: { color: style('--muted'), width: 1, dash: c.direction === 'cw' ? 'dash' : 'dot' }, showlegend: false, hovertemplate: `radius ${c.r.toFixed(1)} mm` },
          { name: capital(names[c.direction]), mode: 'markers', x: c.x, y: c.y, marker: { ...mark, size: 8, line: { width: 1.5, color: colour } },
            text: c.x.map((_, i) => `run ${i + 1}`), hovertemplate: '%{text}: x %{x:.1f} mm, y %{y:.1f} mm' },
          { name: `Mean ${names[c.direction]}`, mode: 'markers+text', x: [c.mean[0]], y: [c.mean[1]], text: [c.direction.toUpperCase()],
            textposition: `${c.mean[1] < 0 ? 'bottom' : 'top'} ${c.mean[0] < 0 ? 'left' : 'right'}`, textfont: { color: style('--ink') },
            marker: { symbol: marks[c.direction][0], size: 15, color: style('--ink'), line: { width: 2, color: style('--ink') } },
            error_x: { type: 'data', array: [c.se[0]], color: style('--ink'), thickness: 1.5, width: 3 },
            error_y: { type: 'data', array: [c.se[1]], color: style('--ink'), thickness: 1.5, width: 3 },
            showlegend: false, cliponaxis: false, hovertemplate: 'mean: x %{x:.1f} mm, y %{y:.1f} mm' },
        ];
      }).map((trace) => ({ type: 'scatter', ...trace }));
      return [traces, layout({
        xaxis: axis('x error in mm', { range: [-reach, reach], constrain: 'domain' }),
        yaxis: axis('y error in mm', { range: [-reach, reach], constrain: 'domain', scaleanchor: 'x' }),
      }), Math.min(width, onPaper() ? 280 : 540)];
    },

    path(data, figure, width) {
      const group = data.groups[figure.group];
      const phase = Number(figure.phase);
      const line = group.kind === 'line';
      const across = line ? 1e3 : 1;
      const trueX = (run) => run.x.map((x, i) => (run.ex[i] === null ? null : x + run.ex[i] / 1e3));
      const trueY = (run) => run.y.map((y, i) => (run.ey[i] === null ? null : (y + run.ey[i] / 1e3) * across));
      const odometryY = (run) => run.y.map((y) => y * across);
      const runs = group.phases.flat();
      const spanX = padded(extent(runs.flatMap((run) => [...run.x, ...trueX(run)])), 0.05);
      const spanY = padded(extent(runs.flatMap((run) => [...odometryY(run), ...trueY(run)])), line ? 5 : 0.05);
      const half = Math.max(spanX[1] - spanX[0], spanY[1] - spanY[0]) / 2;
      const square = ([lo, hi]) => [(lo + hi) / 2 - half, (lo + hi) / 2 + half];
      const where = `x %{x:.3f} m, y %{y:.${line ? 1 : 3}f} ${line ? 'mm' : 'm'}`;
      const traces = chosen(group, phase).flatMap(({ run, first, many }) => {
        const shared = { type: 'scatter', showlegend: first, hovertemplate: where };
        const believed = { ...shared, name: 'Odometry', mode: 'lines', legendgroup: 'o', x: run.x, y: odometryY(run), line: { color: phaseColour(phase), width: many ? 1 : 2, dash: '7px,3px' } };
        if (!run.tracked) return [believed];
        const [tx, ty] = [trueX(run), trueY(run)];
        const last = tx.findLastIndex((x) => x !== null);
        return [
          { ...shared, name: 'True path', mode: 'lines', legendgroup: 't', x: tx, y: ty, line: { color: style('--truth'), width: many ? 0.8 : 1.6 } },
          believed,
          { ...shared, name: 'End error', mode: 'lines+markers', legendgroup: 'e', x: [run.x[last], tx[last]], y: [believed.y[last], ty[last]],
            line: { color: style('--muted'), width: 1 }, marker: { size: 8, symbol: ['circle-open', 'circle'], color: [phaseColour(phase), style('--truth')] } },
        ];
      });
      return [traces, layout({
        xaxis: axis('x in m', line ? { range: spanX } : { range: square(spanX), constrain: 'domain' }),
        yaxis: axis(line ? 'y in mm' : 'y in m', line ? { range: spanY } : { range: square(spanY), constrain: 'domain', scaleanchor: 'x' }),
        annotations: traces.length ? [] : [{ text: 'not driven in this phase', showarrow: false, xref: 'paper', yref: 'paper', x: 0.5, y: 0.5 }],
      }), Math.min(line ? 280 : Math.min(width, 520), onPaper() ? heightOnPaper(group, 'path') : Infinity)];
    },

    // Both maps have one scale, so that what is double in one can be looked up in the other.
    map(data, figure, width) {
      const { maps } = data.scans, number = Number(figure.map);
      const spanX = padded(extent(maps.flatMap((map) => map.x)), 0.5), spanY = padded(extent(maps.flatMap((map) => map.y)), 0.5);
      const traces = [{ type: 'scatter', mode: 'markers', x: maps[number].x, y: maps[number].y, marker: { size: 2.2, color: phaseColour(number), opacity: 0.7 }, hovertemplate: 'x %{x:.2f} m, y %{y:.2f} m<extra></extra>' }];
      const high = (spanY[1] - spanY[0]) / (spanX[1] - spanX[0]) * (width - 68) + 74;
      return [traces, layout({ showlegend: false, xaxis: axis('x in m', { range: spanX, constrain: 'domain' }), yaxis: axis('y in m', { range: spanY, constrain: 'domain', scaleanchor: 'x' }) }), Math.max(220, Math.min(high, onPaper() ? 330 : 620))];
    },

    residuals(data, figure, width) {
      const { way, residuals } = data.scans;
      const rows = [['x', 'ahead<br>in mm', 3], ['y', 'to the left<br>in mm', 3], ['h', 'heading<br>in mrad', 1]];
      const traces = residuals.flatMap((phase, number) => rows.map(([key], row) => ({
        type: 'scatter', mode: 'markers', name: number ? 'Calibrated factors' : 'Factors before', legendgroup: String(number), showlegend: row === 0,
        x: way, y: phase[key], yaxis: row ? `y${row + 1}` : 'y', hovertemplate: '%{y:.1f} at %{x:.1f} m',
        marker: { symbol: phaseMarks[number], size: 4, color: phaseColour(number), opacity: 0.75 },
      })));
      // Slips and people give a few that are far off. The scale is that of the others; zooming out shows all.
      const usual = (values) => values.map(Math.abs).sort((a, b) => a - b)[Math.floor(0.98 * (values.length - 1))] ?? 0;
      const strips = Object.fromEntries(rows.map(([key, title, least], row) => {
        const most = Math.max(least, ...residuals.map((phase) => usual(phase[key]))) * 1.15;
        return [row ? `yaxis${row + 1}` : 'yaxis', axis(title, { range: [-most, most], domain: [(2 - row) * 0.35, (2 - row) * 0.35 + 0.3], nticks: 5 })];
      }));
      const legend = { orientation: 'h', x: 0, y: 1.01, xanchor: 'left', yanchor: 'bottom', itemwidth: 40 };
      return [traces, layout({ ...strips, legend, xaxis: axis('way in m', { anchor: 'y3', rangemode: 'tozero' }), margin: { l: 64, r: 12, t: 34, b: 44 } }), onPaper() ? 430 : width < 500 ? 470 : 540];
    },

    errors(data, figure, width) {
      const group = data.groups[figure.group];
      const rows = [['ex', 'x error<br>in mm', '.1f', 1], ['ey', 'y error<br>in mm', '.1f', 1], ['eh', 'heading error<br>in rad', '.4f', 0.002]];
      const traces = group.phases.flatMap((_, phase) => chosen(group, phase).filter(({ run }) => run.tracked).flatMap(({ run, first, many }) =>
        rows.map(([key, , format], row) => ({
          type: 'scatter', mode: 'lines', name: phaseName(data, phase), legendgroup: String(phase), showlegend: first && row === 0,
          x: run.t, y: run[key], yaxis: row ? `y${row + 1}` : 'y', hovertemplate: `%{y:${format}} at %{x:.1f} s`,
          line: { color: phaseColour(phase), width: many ? 1 : 1.8, dash: dashes[phase % 4] },
        }))));
      const runs = group.phases.flat().filter((run) => run.tracked);
      const strips = Object.fromEntries(rows.map(([key, title, , least], row) => {
        const [lo, hi] = extent(runs.flatMap((run) => run[key]));
        return [row ? `yaxis${row + 1}` : 'yaxis', axis(title, { range: padded([Math.min(lo, 0), Math.max(hi, 0)], least), domain: [(2 - row) * 0.35, (2 - row) * 0.35 + 0.3], nticks: 5 })];
      }));
      const legend = { orientation: 'h', x: 0, y: 1.01, xanchor: 'left', yanchor: 'bottom', itemwidth: 40 };
      return [traces, layout({ ...strips, legend, xaxis: axis('time in s', { anchor: 'y3', rangemode: 'tozero' }), margin: { l: 64, r: 12, t: 34, b: 44 } }), onPaper() ? heightOnPaper(group, 'errors') : width < 500 ? 470 : 540];
    },

    // Speed over voltage, with what accelerating took off: the model is then a line on either side of its dead zone.
    motor(data, figure) {
      const { kS, kV, kA, breakaway, V, a, v } = data.motors[figure.wheel];
      const steady = V.map((volts, i) => volts - kA * a[i]);
      const most = Math.max(1, largest(steady)) * 1.06, speed = (volts) => Math.sign(volts) * Math.max(0, Math.abs(volts) - kS) / kV;
      const traces = [
        { name: 'Measured', mode: 'markers', x: steady, y: v, customdata: a, marker: { size: 5, opacity: 0.45, color: phaseColour(1) }, hovertemplate: '%{x:.2f} V, %{y:.3f} m/s (accelerating by %{customdata:.2f} m/s²)' },
        { name: 'Fit', mode: 'lines', x: [-most, -kS, kS, most], y: [-most, -kS, kS, most].map(speed), line: { color: style('--ink'), width: 1.6 }, hovertemplate: '%{x:.2f} V, %{y:.3f} m/s' },
        { name: 'Breaks away', mode: 'markers', x: breakaway, y: breakaway.map((volts) => (volts === null ? null : 0)), marker: { symbol: 'line-ns', size: 15, line: { width: 2.5, color: phaseColour(0) } }, hovertemplate: 'breaks away at %{x:.2f} V' },
      ].map((trace) => ({ type: 'scatter', ...trace }));
      return [traces, layout({ xaxis: axis('voltage less k<sub>A</sub> dv/dt, in V', { range: [-most, most] }), yaxis: axis('speed in m/s') }), 340];
    },

    step(data, figure, width) {
      const { t, goal, measured, predicted } = data.steps[figure.phase][figure.wheel];
      // Steps behind the robot's limits have one scale; a jump has errors of another size.
      const jumps = (s) => s.goal[0] > 0.9 * s.goal.at(-1), shown = data.steps.flat().filter((s) => jumps(s) === jumps({ goal }));
      const strip = { measured: { color: phaseColour(Number(figure.phase)), width: 3 }, predicted: { color: style('--ink'), width: 1.3, dash: '5px,4px' } };
      const off = (series, set) => series.map((v, i) => (v - set[i]) * 1e3), courses = Object.entries({ measured, predicted }).filter(([, series]) => series.length);
      const traces = [
        { name: 'Set point', x: t, y: goal, line: { color: style('--muted'), width: 1.2 }, hovertemplate: '%{y:.3f} m/s at %{x:.3f} s' },
        ...courses.map(([name, series]) => ({ name: capital(name), legendgroup: name, x: t, y: series, line: strip[name], hovertemplate: '%{y:.4f} m/s at %{x:.3f} s' })),
        ...courses.map(([name, series]) => ({ name: capital(name), legendgroup: name, showlegend: false, x: t, y: off(series, goal), yaxis: 'y2', line: strip[name], hovertemplate: '%{y:.1f} mm/s at %{x:.3f} s' })),
      ].map((trace) => ({ type: 'scatter', mode: 'lines', ...trace }));
      const most = Math.max(2, largest(shown.flatMap((s) => [...off(s.measured, s.goal), ...off(s.predicted, s.goal)]))) * 1.08;
      const top = padded([0, largest(shown.flatMap((s) => [...s.measured, ...s.predicted, ...s.goal]))], 0.01);
      return [traces, layout({ xaxis: axis('time in s', { anchor: 'y2', rangemode: 'tozero' }), yaxis: axis('speed<br>in m/s', { range: top, domain: [0.42, 1] }),
        yaxis2: axis('error<br>in mm/s', { range: [-most, most], domain: [0, 0.34], nticks: 5 }), margin: { l: 64, r: 12, t: 34, b: 44 },
      }), width < 400 ? 360 : 400];
    },
  };

  // The runs that a group's selector asks for, in one phase.
  function chosen(group, phase) {
    const runs = group.phases[phase];
    if (group.choice === 'all') return runs.map((run, i) => ({ run, first: i === 0, many: true }));
    const run = runs[group.choice];
    return run ? [{ run, first: true, many: false }] : [];
  }

  function complain(figure, error) {
    const box = document.getElementById('problem');
    box.hidden = false;
    box.textContent = `A figure could not be drawn (${error.message}). The text and the tables are complete.`;
    if (figure) figure.dataset.error = error.message;
    document.body.dataset.error = error.message;
  }

  async function draw(data, figure) {
    try {
      const plot = figure.querySelector('.plot');
      const [traces, how, height] = drawings[figure.dataset.figure](data, figure.dataset, plot.clientWidth);
      plot.style.minHeight = '0';
      figure.dataset.width = plot.clientWidth;
      await Plotly.react(plot, traces, { ...how, width: plot.clientWidth, height }, config);
      figure.dataset.drawn = 'true';
    } catch (error) {
      complain(figure, error);
    }
  }

  const figures = (within = document) => [...within.querySelectorAll('figure[data-figure]')];

  function listen(data) {
    const redraw = (within) => Promise.all(figures(within).map((figure) => draw(data, figure)));
    for (const selector of document.querySelectorAll('[data-runs]')) {
      const section = selector.closest('[data-group]');
      selector.addEventListener('change', ({ target }) => {
        data.groups[section.dataset.group].choice = target.value;
        const text = target.value === 'all' ? 'all runs' : `run ${target.nextElementSibling.textContent}`;
        for (const place of section.querySelectorAll('.chosen')) place.textContent = text;
        redraw(section);
      });
    }
    document.querySelector('[data-scale]')?.addEventListener('change', ({ target }) => redraw(target.closest('section')));
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => redraw());

    // Also catches a window that changed its size while the figures were being drawn.
    let waiting;
    const watch = new ResizeObserver(() => {
      clearTimeout(waiting);
      waiting = setTimeout(() => figures().forEach((figure) => {
        const plot = figure.querySelector('.plot');
        if (plot.clientWidth !== Number(figure.dataset.width)) draw(data, figure);
      }), 100);
    });
    figures().forEach((figure) => watch.observe(figure));
    const paper = (on) => {
      document.documentElement.toggleAttribute('data-printing', on);
      redraw();
    };
    addEventListener('beforeprint', () => paper(true));
    addEventListener('afterprint', () => paper(false));
  }

  async function start() {
    try {
      const data = JSON.parse(document.getElementById('report-data').textContent);
      for (const group of data.groups) group.choice = '0';
      for (const figure of figures()) {
        // Seconds pass until all are drawn; the text is shown, and scrolls, meanwhile.
        await new Promise((shown) => setTimeout(shown));
        await draw(data, figure);
      }
      listen(data);
    } catch (error) {
      complain(null, error);
    }
    document.body.dataset.ready = 'true';
  }
  start();
})();
