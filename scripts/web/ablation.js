// The speed-up by each optimization: a chart per scene, a line per optimization.
import * as Plot from "@observablehq/plot";
import { widthOf } from "./labels.js";
import { bar, circle, decades, gridAt, legend, plot, sample, tip, verdictColour } from "./look.js";
import { chart, grid, number, short } from "./page.js";

export function ablation(view) {
  const drawn = view.result.ablation.filter(({ scene }) => !view.state.scene || scene === view.state.scene);
  if (!drawn.length) return [];
  const key = legend([
    ...["gain", "loss", "neither"].map((verdict, i) => [
      sample({ colour: verdictColour(view, verdict), symbol: circle }),
      ["faster", "slower", "not settled"][i],
    ]),
    [sample({ colour: kEstimate }, { dash: [1, 1] }), "estimate"],
    ...(view.other ? [[sample({ colour: "var(--faint)", symbol: circle }, { hollow: true }), view.other.name]] : []),
  ]);
  return [key, grid(view, drawn, 340, (scene, width) => panel(view, scene, width))];
}

const kEstimate = "#6e7781";

function panel(view, { scene, steps }, width) {
  const before = view.other?.ablation.find((other) => other.scene === scene)?.steps ?? [];
  const shared = before.filter(({ label }) => steps.some((step) => step.label === label));
  const beforeOf = (step) => shared.find(({ label }) => label === step.label);
  const fill = { value: (step) => verdictColour(view, step.verdict), scale: null };
  const modelled = steps.filter((step) => step.estimate > 0);
  const all = [...steps, ...shared].flatMap(({ ms, estimate }) => [ms[0], estimate || ms[0]]);
  const domain = [Math.min(...all) / 1.5, Math.max(...all) * 1.3];
  const time = (step) => step.ms[0];
  const drawn = plot({
    width,
    height: 44 + 21 * steps.length,
    marginLeft: 14 + Math.max(...steps.map(({ label }) => widthOf(label))),
    marginRight: 60, // for the figure beside the last mark
    marginBottom: 40,
    marginTop: 4,
    x: { type: "log", domain, label: "ms per frame", ticks: decades(domain), tickFormat: short },
    y: { type: "point", domain: steps.map((step) => step.label), label: null, padding: 0.5 },
    marks: [
      gridAt("x", decades(domain)),
      Plot.axisY({ tickSize: 0 }),
      Plot.line(steps, { x: time, y: "label", stroke: "var(--line)", strokeWidth: 1.4 }),
      Plot.link(modelled, {
        x1: "estimate",
        x2: time,
        y1: "label",
        y2: "label",
        stroke: kEstimate,
        strokeDasharray: "1,2",
      }),
      Plot.dot(modelled, { x: "estimate", y: "label", symbol: bar, r: 6, stroke: kEstimate, strokeWidth: 2.5 }),
      Plot.dot(shared, { x: time, y: "label", r: 4, stroke: "var(--faint)" }),
      Plot.dot(steps, { x: time, y: "label", r: 4.5, fill }),
      Plot.text(steps, {
        x: (step) => Math.max(step.ms[0], beforeOf(step)?.ms[0] ?? 0),
        y: "label",
        dx: 9,
        textAnchor: "start",
        fill: "var(--ink)",
        stroke: "var(--paper)",
        strokeWidth: 3,
        text: "said",
      }),
      tip(steps, { x: time, y: "label", says: (step) => says(step, beforeOf(step), view) }),
    ],
    r: { type: "identity" },
  });
  return chart({
    title: scene,
    plot: drawn,
    figures: [
      [
        ["optimization", (step) => step.label],
        ["ms", time],
        ["speed-up", (step) => (step.verdict === "start" ? "–" : step.said)],
        ["estimate, ms", (step) => (step.estimate > 0 ? step.estimate : "–")],
        ...(shared.length ? [[view.other.name, (step) => beforeOf(step)?.ms[0] ?? "–"]] : []),
      ],
      steps,
    ],
  });
}

function says(step, other, view) {
  const [ms, low, high] = step.ms.map(number);
  return [
    step.label,
    `${ms} ms (${low} to ${high})`,
    step.verdict !== "start" &&
      `${step.said.includes("slower") ? step.said : `${step.said} faster`} than the line above${step.verdict === "neither" ? ", not settled" : ""}`,
    step.estimate > 0 && `estimate ${number(step.estimate)} ms`,
    other && `${view.other.name}: ${number(other.ms[0])} ms`,
  ];
}
