'use strict';
(function () {
  const tone = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

  /** 1, 2 or 5 times a power of ten that parts the range into at most so many steps. */
  function niceStep(range, parts) {
    const power = Math.pow(10, Math.floor(Math.log10(range / parts)));
    return power * [1, 2, 5, 10].find((step) => range / parts <= step * power * (1 + 1e-9));
  }

  const charts = [];
  for (const place of document.querySelectorAll('[data-values]')) {
    const values = JSON.parse(place.dataset.values);
    const least = Math.min(...values), most = Math.max(...values);
    const step = niceStep(most > least ? most - least : Math.max(Math.abs(most), 1e-3), 14);
    const first = Math.floor(least / step);
    const counts = new Array(Math.max(1, Math.ceil(most / step - first + 1e-9))).fill(0);
    for (const value of values) {
      ++counts[Math.min(Math.floor(value / step - first), counts.length - 1)];
    }
    const middles = counts.map((_, bin) => (first + bin + 0.5) * step);
    const stroke = () => tone('--soft'), font = '11px system-ui, sans-serif', ticks = {show: false};
    charts.push(new uPlot({
      width: 300, height: 130, padding: [6, 6, 0, 0], legend: {show: false}, cursor: {show: false},
      scales: {x: {time: false, range: () => [first * step, (first + counts.length) * step]},
               y: {range: () => [0, Math.max(...counts)]}},
      axes: [{stroke, font, ticks, size: 22, gap: 3, grid: {show: false}},
             {stroke, font, ticks, size: 30, gap: 4, incrs: [1, 2, 5, 10, 20, 50, 100, 1000],
              grid: {stroke: () => tone('--grid'), width: 1}}],
      series: [{}, {fill: () => tone('--robot'), points: {show: false},
                    paths: uPlot.paths.bars({size: [0.9, 60]})}],
    }, [middles, counts], place));
  }
  function fit() {
    for (const chart of charts) {
      chart.setSize({width: chart.root.parentNode.clientWidth, height: 130});
    }
  }
  addEventListener('resize', fit);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
    for (const chart of charts) chart.redraw(false);
  });
  fit();
  document.documentElement.setAttribute('data-ready', String(charts.length));
})();
