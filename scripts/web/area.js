// The cost of a covered pixel along the triangles' area, a chart for each number of threads.
import * as Plot from "@observablehq/plot";
import { labels } from "./labels.js";
import { asText, backendLegend, backendLook, gridAt, logTicks, plot, tip } from "./look.js";
import { chart, grid, number, short } from "./page.js";

const rowsOf = (found) =>
  (found?.curves ?? []).flatMap(({ backend, points }) =>
    points.map(([area, ns, low, high]) => ({ backend, area, ns, low, high })),
  );

export function area(view) {
  const drawn = view.threads.filter((threads) => view.result.area[threads]);
  if (!drawn.length) return [];
  const everything = [view.result, view.other]
    .filter(Boolean)
    .flatMap((result) => drawn.flatMap((threads) => rowsOf(result.area[threads])));
  const domains = {
    x: [Math.min(...everything.map((row) => row.area)), Math.max(...everything.map((row) => row.area))],
    y: [Math.min(...everything.map((row) => row.low)) / 1.2, Math.max(...everything.map((row) => row.high)) * 1.2],
  };
  return [grid(view, drawn, 420, (threads, width) => panel(view, threads, width, domains))];
}

function panel(view, threads, width, domains) {
  const { crossings } = view.result.area[threads];
  const rows = rowsOf(view.result.area[threads]);
  const before = rowsOf(view.other?.area[threads]);
  const stroke = { value: (row) => backendLook(view, row.backend).colour, scale: null };
  const lines = [...new Set(rows.map((row) => row.backend))].map((backend) =>
    rows.filter((row) => row.backend === backend),
  );
  const ends = lines.map((line) => line.at(-1));
  const drawn = plot({
    width,
    height: 400,
    marginLeft: 46,
    marginRight: 66,
    marginBottom: 42,
    marginTop: 24,
    x: {
      type: "log",
      domain: domains.x,
      label: "area of a triangle, px",
      ticks: logTicks(domains.x),
      tickFormat: short,
    },
    y: { type: "log", domain: domains.y, label: "ns per covered pixel", ticks: logTicks(domains.y), tickFormat: short },
    marks: [
      gridAt("x", logTicks(domains.x)),
      gridAt("y", logTicks(domains.y)),
      Plot.areaY(rows, { x: "area", y1: "low", y2: "high", z: "backend", fill: stroke, fillOpacity: 0.18 }),
      Plot.line(before, { x: "area", y: "ns", z: "backend", stroke, strokeWidth: 1.2, strokeDasharray: "4,3" }),
      Plot.line(rows, { x: "area", y: "ns", z: "backend", stroke, strokeWidth: 2 }),
      Plot.dot(rows, {
        x: "area",
        y: "ns",
        fill: stroke,
        stroke: "var(--paper)",
        strokeWidth: 0.6,
        symbol: (row) => backendLook(view, row.backend).symbol,
        r: 4,
      }),
      Plot.dot(crossings, { x: "x", y: "y", r: 8, stroke: "var(--ink)", strokeWidth: 1.3 }),
      Plot.text(apart(ends, domains.y, 400 - 66), {
        x: "area",
        y: "at",
        text: "backend",
        fill: { value: (row) => asText(backendLook(view, row.backend).colour), scale: null },
        fontWeight: "bold",
        textAnchor: "start",
        dx: 7,
      }),
      labels(
        crossings.map(({ x, y, backends, area }) => ({ x, y, least: 13, text: `${backends.join(" × ")}\n${area} px` })),
        {
          points: [...rows.map((row) => [row.area, row.ns]), ...crossings.map(({ x, y }) => [x, y])],
          lines: lines.map((line) => line.map((row) => [row.area, row.ns])),
        },
      ),
      tip(rows, { x: "area", y: "ns", says: (row) => says(row, threads, before, view) }),
    ],
    r: { type: "identity" },
  });
  return chart({
    title: `${threads} thread${threads > 1 ? "s" : ""}`,
    plot: drawn,
    legend: backendLegend(view),
    text:
      (crossings.length
        ? `Crossings: ${crossings.map((c) => `${c.backends.join(" × ")} at ${c.area} px`).join("; ")}.`
        : "No crossing is clear of noise.") + (before.length ? ` Dashed: ${view.other.name}.` : ""),
    figures: [
      [
        ["backend", (row) => row.backend],
        ["area, px", (row) => row.area],
        ["ns per covered pixel", (row) => row.ns],
        ["fastest", (row) => row.low],
        ["slowest", (row) => row.high],
      ],
      rows,
    ],
  });
}

// The names at the ends of curves, moved apart to at least a line.
function apart(ends, [low, high], height) {
  const line = Math.exp((15 / height) * Math.log(high / low));
  const placed = ends.map((row) => ({ ...row, at: row.ns })).sort((a, b) => a.at - b.at);
  for (let i = 1; i < placed.length; ++i) placed[i].at = Math.max(placed[i].at, placed[i - 1].at * line);
  return placed;
}

function says(row, threads, before, view) {
  const other = before.find((b) => b.backend === row.backend && b.area === row.area);
  return [
    `${row.backend}, ${threads} thread${threads > 1 ? "s" : ""}`,
    `triangles of ${short(row.area)} px`,
    `${number(row.ns)} ns per covered pixel (${number(row.low)} to ${number(row.high)})`,
    other && `${view.other.name}: ${number(other.ns)}`,
  ];
}
