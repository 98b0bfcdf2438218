// The estimated speed-up of a frame on more cores, a chart per scene.
import * as Plot from "@observablehq/plot";
import { backendLegend, backendLook, gridAt, plot, tip } from "./look.js";
import { chart, grid, number } from "./page.js";

export function scaling(view) {
  const scenes = [...new Set(view.result.scaling.map(({ scene }) => scene))].filter(
    (scene) => !view.state.scene || scene === view.state.scene,
  );
  if (!scenes.length) return [];
  const most = Math.max(...view.result.scaling.flatMap(({ points }) => points.map(([cores]) => cores)));
  const note = view.other ? [`Dashed: ${view.other.name}.`] : [];
  return [backendLegend(view), ...note, grid(view, scenes, 300, (scene, width) => panel(view, scene, width, most))];
}

function panel(view, scene, width, most) {
  const curves = view.result.scaling.filter((curve) => curve.scene === scene);
  const before = view.other?.scaling.filter((curve) => curve.scene === scene) ?? [];
  const unfold = (curve, points) => points.map(([cores, gain]) => ({ ...curve, cores, gain }));
  const rows = curves.flatMap((curve) => unfold(curve, curve.points));
  const ticks = Array.from({ length: Math.log2(most) + 1 }, (_, i) => 2 ** i).filter((_, i) => i < 4 || i % 2);
  const axis = { type: "log", base: 2, domain: [0.9, most * 1.1], ticks };
  const stroke = { value: (row) => backendLook(view, row.backend).colour, scale: null };
  const drawn = plot({
    width,
    height: 260,
    marginLeft: 44,
    marginRight: 12,
    marginBottom: 38,
    marginTop: 10,
    x: { ...axis, tickFormat: String, label: "cores" },
    y: { ...axis, tickFormat: (gain) => `${gain}×`, label: null },
    marks: [
      gridAt("x", ticks),
      gridAt("y", ticks),
      Plot.line(
        [
          [1, 1],
          [most, most],
        ],
        { stroke: "var(--faint)", strokeDasharray: "2,2" },
      ),
      before.map((curve) =>
        Plot.line(curve.points, {
          stroke: backendLook(view, curve.backend).colour,
          strokeWidth: 1,
          strokeDasharray: "4,3",
        }),
      ),
      Plot.line(rows, { x: "cores", y: "gain", z: "backend", stroke, strokeWidth: 1.8 }),
      Plot.dot(rows, {
        x: "cores",
        y: "gain",
        r: 3.2,
        fill: stroke,
        symbol: (row) => backendLook(view, row.backend).symbol,
      }),
      Plot.dot(
        curves.flatMap((curve) => unfold(curve, curve.measured)),
        { x: "cores", y: "gain", r: 6, stroke, strokeWidth: 1.5 },
      ),
      tip(rows, {
        x: "cores",
        y: "gain",
        says: (row) => [
          `${row.backend}, ${row.cores} core${row.cores > 1 ? "s" : ""}`,
          `${number(row.gain)}× allowed`,
          ...row.measured.filter(([threads]) => threads === row.cores).map(([, gain]) => `${number(gain)}× measured`),
          `on the most cores: ${row.serial}`,
        ],
      }),
    ],
    r: { type: "identity" },
  });
  const first = curves.find((curve) => curve.first);
  return chart({
    title: scene,
    plot: drawn,
    text: first ? `${first.backend}: ${first.serial}.` : "",
    figures: [
      [
        ["backend", (row) => row.backend],
        ["cores", (row) => row.cores],
        ["speed-up", (row) => row.gain],
        ["measured", (row) => row.measured.find(([threads]) => threads === row.cores)?.[1] ?? "–"],
      ],
      rows,
    ],
  });
}
