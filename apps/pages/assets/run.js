'use strict';
(function () {
  const run = JSON.parse(document.getElementById('run').textContent);
  const byId = (id) => document.getElementById(id);
  const count = run.t.length, last = count - 1;
  const timeline = byId('timeline'), cursor = byId('cursor'), scrub = byId('scrub');
  const selection = byId('selection'), play = byId('play'), speed = byId('speed');
  const begin = count ? run.t[0] : 0, end = count ? Math.max(run.t[last] - begin, 1e-3) : 1;
  const time = run.t.map((stamp) => stamp - begin);  // what the timeline shows [s]
  const view = {from: 0, to: end};                   // the part of it that is shown
  let film = byId('film'), now = 0, frame = 0, asked = -1;

  /** The last moment of which `values`, which rise, are not above `value`. */
  function lastUpTo(values, value) {
    let low = 0, high = last;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (values[middle] <= value) low = middle; else high = middle - 1;
    }
    return low;
  }

  // --- One moment ------------------------------------------------------------------------------

  const tone = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const gutter = () => parseFloat(getComputedStyle(timeline).getPropertyValue('--gutter'));

  function placeCursor() {
    const share = count ? (time[now] - view.from) / (view.to - view.from) : 0;
    cursor.style.left = 'calc(var(--gutter) + (100% - var(--gutter)) * ' + share + ')';
    cursor.classList.toggle('gone', share < 0 || share > 1);
  }

  function put(id, mark) {
    const at = mark.at[now], turn = mark.turn ? mark.turn[now] : 0, drawn = byId(id);
    drawn.setAttribute('visibility', at ? 'visible' : 'hidden');
    if (at) drawn.setAttribute('transform', 'translate(' + at[0] + ' ' + at[1] + ')' +
                                            (turn ? ' rotate(' + turn + ')' : ''));
    if (at && mark.label) drawn.lastElementChild.textContent = mark.label[now];
  }

  function show(index) {
    if (!count) return;
    now = Math.min(Math.max(index, 0), last);
    const span = view.to - view.from;
    if (time[now] < view.from) zoom(time[now], time[now] + span);
    if (time[now] > view.to) zoom(time[now] - span, time[now]);
    placeCursor();
    scrub.value = now;
    const state = run.states[run.state[now]], shown = time[now].toFixed(1);
    byId('now-time').textContent = shown;
    byId('now-state').textContent = state.name;
    byId('now-state').style.setProperty('--tone', 'var(' + state.tone + ')');
    byId('now-reason').textContent = run.reasons[run.reason[now]];
    scrub.setAttribute('aria-valuetext', shown + ' seconds, ' + state.name);
    for (const place of document.querySelectorAll('[data-column]')) {
      const value = run.columns[place.dataset.column][now];
      place.textContent = value === null ? '\u2013' :
        value.toFixed(place.dataset.digits) + '\u00a0' + place.dataset.unit;
    }
    for (const id in run.marks) put(id, run.marks[id]);
  }

  /** Shows a moment, here and in the film. */
  function go(index) {
    show(index);
    if (!film || !run.film || !count) return;
    asked = (Math.max(run.film.picture[now], 0) + 0.5) / run.film.rate;
    film.currentTime = asked;
  }

  // --- Playing: the film leads, where there is one ---------------------------------------------

  const filmMoment = () => lastUpTo(run.film.picture, Math.floor(film.currentTime * run.film.rate));

  function playing(is) {
    cancelAnimationFrame(frame);
    frame = 0;
    play.textContent = is ? 'Pause' : 'Play';
    play.setAttribute('aria-pressed', String(is));
  }

  function stop() {
    playing(false);
    if (film) film.pause();
  }

  function followFilm() {
    show(filmMoment());
    frame = requestAnimationFrame(followFilm);
  }

  function start() {
    if (!count) return;
    if (now === last) go(0);
    if (film) {
      film.playbackRate = Number(speed.value);
      const promise = film.play();
      if (promise) promise.catch(() => playing(false));
      return;
    }
    let before = performance.now(), at = time[now];
    playing(true);
    frame = requestAnimationFrame(function step(stamp) {
      at += Math.max(0, stamp - before) / 1000 * Number(speed.value);
      before = stamp;
      show(lastUpTo(time, at));
      if (now === last) stop(); else frame = requestAnimationFrame(step);
    });
  }

  if (film) {
    const leave = () => {  // its file is not there, or of a format that is not played here
      if (!film) return;
      byId('film-card').remove();
      byId('place').classList.add('no-film');
      film = null;
      playing(false);
    };
    film.addEventListener('error', leave);
    film.addEventListener('play', () => { playing(true); followFilm(); });
    film.addEventListener('pause', () => playing(false));
    film.addEventListener('seeking', () => {
      if (Math.abs(film.currentTime - asked) > 1e-3) show(filmMoment());
    });
    if (film.error) leave();
  }

  // --- Charts ----------------------------------------------------------------------------------

  function axes(is_ruler) {
    const stroke = () => tone('--soft'), font = '12px system-ui, sans-serif';
    const grid = {stroke: () => tone('--grid'), width: 1}, ticks = {show: false};
    // A number at the right end would be cut.
    const fits = (v) => is_ruler && v < view.to - 0.02 * (view.to - view.from);
    const clock = (u, values) => values.map((v) => fits(v) ? +v.toFixed(2) + (v ? '' : ' s') : '');
    return [{stroke, font, grid: is_ruler ? {show: false} : grid, ticks, space: 70, gap: 4,
             size: is_ruler ? 24 : 0, values: clock},
            {stroke, font, grid, ticks, size: gutter, gap: 6, space: 26,
             values: is_ruler ? () => [] : undefined}];
  }

  /** Tints the times without a target, and draws the limit. */
  function behind(chart) {
    return (u) => {
      const {left, top, width, height} = u.bbox, context = u.ctx;
      context.save();
      context.beginPath();
      context.rect(left, top, width, height);
      context.clip();
      context.fillStyle = tone('--bad') + '1c';
      for (const [from, to] of chart.tint ? run.lost : []) {
        const x = u.valToPos(from - begin, 'x', true);
        context.fillRect(x, top, u.valToPos(to - begin, 'x', true) - x, height);
      }
      if (chart.limit !== null) {
        const y = u.valToPos(chart.limit, 'y', true);
        context.strokeStyle = tone('--soft');
        context.lineWidth = devicePixelRatio;
        context.setLineDash([4 * devicePixelRatio, 3 * devicePixelRatio]);
        context.beginPath();
        context.moveTo(left, y);
        context.lineTo(left + width, y);
        context.stroke();
      }
      context.restore();
    };
  }

  function makeChart(chart) {
    const values = run.columns[chart.column];
    const top = Math.min(Math.max(1.05 * Math.max(0, chart.limit, ...values.filter(isFinite)),
                                  chart.least_top), chart.most_top);
    const alone = [];  // values without a neighbour to draw a line to
    values.forEach((v, i) => {
      if (v !== null && (values[i - 1] ?? null) === null && (values[i + 1] ?? null) === null)
        alone.push(i);
    });
    const color = () => tone(chart.tone);
    return new uPlot({
      width: 300, height: 100, padding: [8, 0, 8, 0], legend: {show: false}, cursor: {show: false},
      scales: {x: {time: false, range: () => [view.from, view.to]}, y: {range: () => [0, top]}},
      axes: axes(false),
      series: [{}, {stroke: color, fill: () => color() + '1f', width: 1.6,
                    points: {show: true, size: 4, stroke: color, fill: color, filter: () => alone}}],
      hooks: {drawClear: [behind(chart)]},
    }, [time, values], byId(chart.id));
  }

  function makeRuler() {
    return new uPlot({
      width: 300, height: 24, padding: [0, 0, 0, 0], legend: {show: false}, cursor: {show: false},
      scales: {x: {time: false, range: () => [view.from, view.to]}, y: {range: () => [0, 1]}},
      axes: axes(true), series: [{}, {show: false}],
    }, [time, time], byId('ruler'));
  }

  const charts = count ? run.charts.map(makeChart) : [];
  const ruler = count ? makeRuler() : null;

  function fit() {
    const width = timeline.clientWidth;
    for (const chart of charts) chart.setSize({width, height: 100});
    if (ruler) ruler.setSize({width, height: 24});
  }
  new ResizeObserver(fit).observe(timeline);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
    for (const chart of charts.concat(ruler || [])) chart.redraw(false);
  });

  function zoom(from, to) {
    const least = Math.min(end, Math.max(4 * end / Math.max(count, 1), 0.2));
    const span = Math.min(Math.max(to - from, least), end);
    view.from = Math.min(Math.max((from + to - span) / 2, 0), end - span);
    view.to = view.from + span;
    for (const chart of charts.concat(ruler || [])) {
      chart.setScale('x', {min: view.from, max: view.to});
    }
    for (const band of timeline.querySelectorAll('.wide')) {
      band.style.width = 100 * end / span + '%';
      band.style.left = -100 * view.from / span + '%';
    }
    placeCursor();
  }

  function zoomBy(factor) {
    const half = (view.to - view.from) * factor / 2, middle = count ? time[now] : 0;
    zoom(middle - half, middle + half);
  }

  // --- Pointer and keys ------------------------------------------------------------------------

  /** The time that a pointer is at [s]. */
  function timeAt(event) {
    const box = timeline.getBoundingClientRect(), left = gutter();
    const share = (event.clientX - box.left - left) / (box.width - left);
    return view.from + Math.min(Math.max(share, 0), 1) * (view.to - view.from);
  }

  let pressed = null;  // where a pointer went down, and at what time
  timeline.addEventListener('pointerdown', (event) => {
    if (event.button !== 0 || event.target.closest('.legend')) return;
    pressed = {x: event.clientX, time: timeAt(event)};
    stop();
  });
  addEventListener('pointermove', (event) => {
    if (!pressed) return;
    if (event.pointerType === 'touch') {
      go(lastUpTo(time, timeAt(event)));
      return;
    }
    const box = timeline.getBoundingClientRect();
    const from = Math.min(pressed.x, event.clientX), to = Math.max(pressed.x, event.clientX);
    selection.classList.toggle('gone', to - from < 6);
    selection.style.left = from - box.left + 'px';
    selection.style.width = to - from + 'px';
  });
  addEventListener('pointerup', (event) => {
    if (!pressed) return;
    const from = pressed, to = timeAt(event);
    pressed = null;
    selection.classList.add('gone');
    if (event.pointerType !== 'touch' && Math.abs(event.clientX - from.x) >= 6) {
      zoom(Math.min(from.time, to), Math.max(from.time, to));
    } else {
      go(lastUpTo(time, to));
    }
  });
  addEventListener('pointercancel', () => { pressed = null; selection.classList.add('gone'); });

  const toggle = () => { if (frame) stop(); else start(); };
  play.addEventListener('click', toggle);
  speed.addEventListener('change', () => { if (film) film.playbackRate = Number(speed.value); });
  scrub.addEventListener('input', () => { stop(); go(Number(scrub.value)); });
  byId('zoom-in').addEventListener('click', () => zoomBy(0.5));
  byId('zoom-out').addEventListener('click', () => zoomBy(2));
  byId('zoom-all').addEventListener('click', () => zoom(0, end));
  const keys = {
    ArrowLeft: (event) => { stop(); go(now - (event.shiftKey ? 10 : 1)); },
    ArrowRight: (event) => { stop(); go(now + (event.shiftKey ? 10 : 1)); },
    Home: () => { stop(); go(0); },
    End: () => { stop(); go(last); },
    ' ': toggle,
    '+': () => zoomBy(0.5),
    '-': () => zoomBy(2),
    '0': () => zoom(0, end),
  };
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || !keys[event.key]) return;
    // What has keys of its own keeps them; of the buttons that is the space bar.
    if (event.target.closest('input, select, video')) return;
    if (event.key === ' ' && event.target.closest('button, summary')) return;
    event.preventDefault();
    keys[event.key](event);
  });
  for (const button of document.querySelectorAll('[data-stamp]')) {
    button.addEventListener('click', () => {
      stop();
      go(lastUpTo(run.t, Number(button.dataset.stamp)));
      byId('what').scrollIntoView({behavior: 'smooth'});
    });
  }

  fit();
  zoom(0, end);
  if (film && film.readyState === 0) {
    film.addEventListener('loadedmetadata', () => go(now), {once: true});
    show(run.start);
  } else {
    go(run.start);
  }
  document.documentElement.setAttribute('data-ready', String(count));
})();
