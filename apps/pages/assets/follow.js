'use strict';
(function () {
  // <![CDATA[
  const run = JSON.parse(document.getElementById('run').textContent);
  const byId = (id) => document.getElementById(id);
  const count = run.t.length;
  const timeline = byId('timeline'), cursor = byId('cursor'), scrub = byId('scrub');
  const play = byId('play'), film = byId('film');
  const begin = count ? run.t[0] : 0, span = count ? Math.max(run.t[count - 1] - begin, 1e-6) : 1;
  let now = 0, timer = 0;

  const text = (value, digits, unit) =>
    value === null ? '\u2013' : value.toFixed(digits) + '\u00a0' + unit;

  function put(id, at, turn) {
    const mark = byId(id);
    if (!mark) return;
    mark.setAttribute('visibility', at ? 'visible' : 'hidden');
    if (at) mark.setAttribute('transform', 'translate(' + at[0] + ' ' + at[1] + ')' +
                                           (turn ? ' rotate(' + turn + ')' : ''));
  }

  function show(index) {
    if (!count) return;
    now = Math.min(Math.max(index, 0), count - 1);
    const share = (run.t[now] - begin) / span;
    cursor.style.left = 'calc(var(--gutter) + (100% - var(--gutter)) * ' + share + ')';
    scrub.value = now;
    const state = run.states[run.state[now]];
    byId('now-time').textContent = (run.t[now] - begin).toFixed(1);
    byId('now-state').textContent = state.name;
    byId('now-state').style.setProperty('--tone', 'var(' + state.tone + ')');
    byId('now-reason').textContent = run.reasons[run.reason[now]];
    byId('now-distance').textContent = text(run.distance[now], 2, 'm');
    byId('now-speed').textContent = text(run.speed[now], 2, 'm/s');
    byId('now-clearance').textContent = text(run.clearance[now], 2, 'm');
    byId('now-error').textContent = text(run.error[now], 2, 'm');
    put('now-robot', run.robot[now], -run.yaw[now]);
    put('now-person', run.person[now]);
    put('now-estimate', run.estimate[now]);
    for (let i = 0; i !== run.others.length; ++i) put('now-other-' + i, run.others[i][now]);
    scrub.setAttribute('aria-valuetext',
                       (run.t[now] - begin).toFixed(1) + ' seconds, ' + state.name);
  }

  /** The last moment up to a time. */
  function at(time) {
    let low = 0, high = count - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (run.t[middle] <= time) low = middle; else high = middle - 1;
    }
    return low;
  }

  function stop() {
    cancelAnimationFrame(timer);
    timer = 0;
    play.textContent = 'Play';
    play.setAttribute('aria-pressed', 'false');
  }

  function start() {
    if (now === count - 1) show(0);
    const rate = Math.max(4, span / 30);  // the whole run in half a minute
    let before = performance.now(), time = run.t[now];
    play.textContent = 'Pause';
    play.setAttribute('aria-pressed', 'true');
    timer = requestAnimationFrame(function step(stamp) {
      time += Math.max(0, stamp - before) / 1000 * rate;
      before = stamp;
      show(at(time));
      if (now === count - 1) stop(); else timer = requestAnimationFrame(step);
    });
  }

  function point(event) {
    const gutter = parseFloat(getComputedStyle(timeline).getPropertyValue('--gutter'));
    const box = timeline.getBoundingClientRect();
    const share = (event.clientX - box.left - gutter) / (box.width - gutter);
    if (share < -0.02 || share > 1.02 || event.target === scrub) return;
    stop();
    show(at(begin + share * span));
  }

  timeline.addEventListener('pointermove', point);
  timeline.addEventListener('pointerdown', point);
  scrub.addEventListener('input', () => { stop(); show(Number(scrub.value)); });
  play.addEventListener('click', () => { if (timer) stop(); else if (count) start(); });
  for (const button of document.querySelectorAll('.shot button')) {
    button.addEventListener('click', () => {
      stop();
      show(at(Number(button.dataset.stamp)));
      byId('where').scrollIntoView({behavior: 'smooth'});
    });
  }
  // Without its file beside the page the film is left out.
  if (film) {
    const leave = () => byId('film-card').classList.add('gone');
    film.addEventListener('error', leave);
    if (film.error) leave();
  }
  show(run.start);
  document.documentElement.setAttribute('data-ready', String(count));
  // ]]>
})();
