// Milliseconds per frame beside the cost model's estimate, and the speed-up of ours over the peers.
import * as Plot from "@observablehq/plot";
import { widthOf } from "./labels.js";
import { backendLegend, backendLook, bar, decades, gridAt, legend, logTicks, plot, sample, tip } from "./look.js";
import { chart, grid, number, short } from "./page.js";

const chosen = (view, rows) =>
  rows.filter((row) => view.threads.includes(row.threads) && (!view.state.scene || row.scene === view.state.scene));

export function peers(view) {
  const timed = chosen(view, view.result.times);
  const others = [...new Set(view.result.peers.map(({ peer }) => peer))];
  const charts = [
    ...(timed.length ? [(width) => timesChart(view, timed, width)] : []),
    ...others
      .map((peer) => [peer, chosen(view, view.result.peers).filter((row) => row.peer === peer)])
      .filter(([, rows]) => rows.length)
      .map(
        ([peer, rows]) =>
          (width) =>
            peerChart(view, peer, rows, width),
      ),
  ];
  return charts.length ? [grid(view, charts, 480, (draw, width) => draw(width))] : [];
}

// Options that both charts share: a line per scene, within it a place for each backend, hollow for one thread.
function lines(view, rows, width, x) {
  const scenes = [...new Set(rows.map((row) => row.scene))];
  const { backends } = view.result;
  const look = (row) => backendLook(view, row.backend);
  const y = (row) =>
    scenes.indexOf(row.scene) + (0.66 / backends.length) * (backends.indexOf(row.backend) - (backends.length - 1) / 2);
  const stroke = { value: (row) => look(row).colour, scale: null };
  return {
    y,
    stroke,
    options: {
      width,
      height: 60 + 30 * scenes.length,
      marginLeft: 14 + Math.max(...scenes.map((scene) => widthOf(scene))),
      marginRight: 14,
      marginBottom: 42,
      marginTop: 6,
      y: {
        domain: [-0.5, scenes.length - 0.5],
        reverse: false,
        label: null,
        ticks: scenes.map((_, i) => i),
        tickFormat: (i) => scenes[i],
        tickSize: 0,
      },
      x,
      r: { type: "identity" },
    },
    stripes: [
      Plot.rect(
        scenes.map((_, i) => i).filter((i) => i % 2),
        { y1: (i) => i - 0.5, y2: (i) => i + 0.5, fill: "var(--stripe)" },
      ),
      gridAt("x", x.ticks),
    ],
    dots: (found, value) =>
      Plot.dot(found, {
        x: value,
        y,
        r: 4.5,
        symbol: (row) => look(row).symbol,
        stroke,
        strokeWidth: 1.5,
        fill: { value: (row) => (row.threads === 1 ? "var(--paper)" : look(row).colour), scale: null },
      }),
    faint: (found, value) =>
      Plot.dot(
        found.filter((row) => scenes.includes(row.scene)),
        { x: value, y, r: 3, fill: "var(--faint)", fillOpacity: 0.8, symbol: (row) => look(row).symbol },
      ),
  };
}

const flip = (options) => ({ ...options, y: { ...options.y, domain: [...options.y.domain].reverse() } });

const hollow = (view) => (view.threads.length > 1 ? " Hollow: 1 thread; filled: 2." : "");

function timesChart(view, rows, width) {
  const before = view.other ? chosen(view, view.other.times) : [];
  const all = [...rows, ...before].flatMap(({ ms, estimates }) => [ms[0], estimates[0] ?? ms[0]]);
  const domain = [Math.min(...all) / 1.3, Math.max(...all) * 1.3];
  const time = (row) => row.ms[0];
  const parts = lines(view, rows, width, {
    type: "log",
    domain,
    ticks: decades(domain),
    tickFormat: short,
    label: "ms per frame, backend alone, clear included",
  });
  const modelled = rows.filter((row) => row.estimates.length);
  const faint = "#6e7781";
  const drawn = plot({
    ...flip(parts.options),
    marks: [
      ...parts.stripes,
      Plot.link(modelled, {
        x1: (row) => row.estimates[0],
        x2: time,
        y1: parts.y,
        y2: parts.y,
        stroke: faint,
        strokeDasharray: "1,2",
      }),
      Plot.dot(modelled, { x: (row) => row.estimates[0], y: parts.y, symbol: bar, r: 5, stroke: faint, strokeWidth: 2.5 }),
      parts.faint(before, time),
      parts.dots(rows, time),
      tip(rows, { x: time, y: parts.y, says: (row) => timesSay(row, before, view) }),
    ],
  });
  return chart({
    title: "Milliseconds per frame, and an estimate",
    plot: drawn,
    text: `Lower is better.${hollow(view)} Grey bars: the cost model's estimate if only blocks with a visible triangle are drawn.${before.length ? ` Small and grey: ${view.other.name}.` : ""}`,
    legend: legend([
      ...view.result.backends.map((name) => [sample(backendLook(view, name)), name]),
      [sample({ colour: faint }, { dash: [1, 1] }), "estimate"],
    ]),
    figures: [
      [
        ["scene", (row) => row.scene],
        ["backend", (row) => row.backend],
        ["threads", (row) => row.threads],
        ["ms", time],
        ["fastest", (row) => row.ms[1]],
        ["slowest", (row) => row.ms[2]],
        ["estimate, ms", (row) => row.estimates[0] ?? "–"],
        ["of covered blocks, ms", (row) => row.estimates[1] ?? "–"],
        ["in tiles, ms", (row) => row.estimates[2] ?? "–"],
        ["time / estimate", (row) => (row.estimates.length ? row.ms[0] / row.estimates[0] : "–")],
      ],
      rows,
    ],
  });
}

function timesSay(row, before, view) {
  const other = before.find((b) => b.scene === row.scene && b.backend === row.backend && b.threads === row.threads);
  const [ms, low, high] = row.ms.map(number);
  return [
    `${row.scene}: ${row.backend}, ${row.threads} thread${row.threads > 1 ? "s" : ""}`,
    `${ms} ms (${low} to ${high})`,
    row.estimates.length && `estimate ${number(row.estimates[0])} ms`,
    row.estimates.length && `estimate for all covered blocks ${number(row.estimates[1])} ms`,
    row.estimates.length && `estimate in tiles ${number(row.estimates[2])} ms`,
    other && `${view.other.name}: ${number(other.ms[0])} ms`,
  ];
}

function peerChart(view, peer, found, width) {
  const unfold = (rows) =>
    rows
      .filter((row) => row.peer === peer)
      .flatMap((row) => Object.entries(row.ratios).map(([backend, ratio]) => ({ ...row, backend, ratio })));
  const rows = unfold(found);
  const before = view.other ? unfold(chosen(view, view.other.peers)) : [];
  const ratios = [...rows, ...before].map((row) => row.ratio);
  const domain = [Math.min(1, ...ratios) / 1.2, Math.max(...ratios) * 1.2];
  const parts = lines(view, rows, width, {
    type: "log",
    domain,
    ticks: logTicks(domain),
    tickFormat: (ratio) => `${short(ratio)}×`,
    label: `speed-up over ${peer}`,
  });
  const drawn = plot({
    ...flip(parts.options),
    marks: [
      ...parts.stripes,
      Plot.ruleX([1], { stroke: "var(--faint)" }),
      Plot.link(rows, {
        x1: 1,
        x2: "ratio",
        y1: parts.y,
        y2: parts.y,
        stroke: parts.stroke,
        strokeWidth: 1.6,
        strokeOpacity: 0.6,
      }),
      parts.faint(before, "ratio"),
      parts.dots(rows, "ratio"),
      tip(rows, {
        x: "ratio",
        y: parts.y,
        says: (row) => [
          `${row.scene}: ${peer} over ${row.backend}`,
          `${number(row.ratio)}× on ${row.threads} thread${row.threads > 1 ? "s" : ""}`,
          `${peer}: ${number(row.ms[0])} ms from ${row.draws} to picture`,
        ],
      }),
    ],
  });
  return chart({
    title: `Speed-up of ours over ${peer}`,
    plot: drawn,
    legend: backendLegend(view),
    text: `${view.result.peer_versions[peer]}. Meshes from vertices to picture, others from screen triangles.${hollow(view)}${before.length ? ` Small and grey: ${view.other.name}.` : ""}`,
    figures: [
      [
        ["scene", (row) => row.scene],
        ["threads", (row) => row.threads],
        [`${peer}, ms`, (row) => row.ms[0]],
        ["over", (row) => row.backend],
        ["speed-up", (row) => row.ratio],
        ["from", (row) => row.draws],
      ],
      rows,
    ],
  });
}
