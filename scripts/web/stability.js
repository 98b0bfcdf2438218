// Errors along a sweep from easy to hard, a chart per sweep; below it the methods of each line, and their first failures.
import * as Plot from "@observablehq/plot";
import { gridAt, kindLook, legend, plot, sample, tip, zeroScale } from "./look.js";
import { chart, element, folded, grid, number, short, table } from "./page.js";

export function stability(view) {
  const drawn = view.result.stability.filter(({ family }) => family === view.state.family);
  return drawn.length ? [grid(view, drawn, 460, (sweep, width) => panel(view, sweep, width))] : [];
}

const capital = (text) => text[0].toUpperCase() + text.slice(1);

function panel(view, sweep, width) {
  const curves = sweep.curves.map((curve) => ({
    ...curve,
    ...kindLook(view, sweep.family, curve.kind),
    names: curve.methods.map(([name]) => name).join(", "),
  }));
  const rowsOf = (curve) => curve.points.map(([x, y, errors], i) => ({ ...curve, x, y, errors, trial: i }));
  const rows = curves.flatMap(rowsOf);
  const before = view.other?.stability.find(({ name }) => name === sweep.name)?.curves ?? [];
  const xs = rows.map((row) => row.x);
  const log = sweep.x.log && Math.min(...xs) > 0;
  const ends = [Math.min(...xs), Math.max(...xs)];
  const failing = curves
    .filter(({ fails }) => fails !== null)
    .map((curve) => ({ ...curve, ...rowsOf(curve).find((row) => row.x === curve.fails) }));
  const unit = sweep.x.unit && `, ${sweep.x.unit}`;
  const drawn = plot({
    width,
    height: 300,
    marginLeft: 50,
    marginRight: 14,
    marginBottom: 42,
    marginTop: 24,
    x: {
      type: log ? "log" : "linear",
      domain: sweep.x.down ? [...ends].reverse() : ends,
      label: `${sweep.x.name}${unit}`,
      nice: false,
      ...(log ? { ticks: powers(ends, width), tickFormat: power } : { ticks: 5 }),
    },
    y: sweep.axis ? zeroScale(sweep.axis, sweep.y) : { label: sweep.y, nice: true, tickFormat: short },
    marks: [
      sweep.axis && Plot.rect([sweep.axis], { y1: "start", y2: "end", fill: "var(--band)" }),
      sweep.axis
        ? gridAt(
            "y",
            sweep.axis.ticks.map(([place]) => place),
          )
        : Plot.gridY({ stroke: "var(--grid)", strokeOpacity: 1 }),
      before.map((curve) => Plot.line(curve.points, { stroke: "var(--faint)", strokeWidth: 0.8, strokeOpacity: 0.7 })),
      curves.map((curve) =>
        Plot.line(curve.points, {
          stroke: curve.colour,
          strokeWidth: curve.kind === "ours" ? 2.6 : 1.6,
          strokeDasharray: curve.dash.map((n) => 1.6 * n).join(" ") || null,
        }),
      ),
      Plot.dot(failing, {
        x: "x",
        y: "y",
        r: 5,
        symbol: "symbol",
        fill: "var(--paper)",
        stroke: { value: "colour", scale: null },
        strokeWidth: 1.8,
      }),
      tip(rows, {
        x: "x",
        y: "y",
        says: (row) => [
          row.names,
          `at ${number(row.x)} ${sweep.x.unit}`,
          `${short(row.errors)} ${sweep.y}`,
          `starts to fail: ${row.failing}`,
        ],
      }),
    ],
    r: { type: "identity" },
  });
  const lines = legend(
    curves.map((curve) => [
      sample(
        { ...curve, symbol: curve.fails === null ? null : curve.symbol },
        { hollow: true, dash: curve.dash.length ? curve.dash : [100], width: 34 },
      ),
      "",
      false,
    ]),
  );
  [...lines.children].forEach((item, i) =>
    item.append(...namesOf(curves[i]), element("span", { class: "faint" }, `: ${curves[i].failing}`)),
  );
  return chart({
    title: sweep.name.replaceAll(/[_-]/g, " "),
    text: `${capital(sweep.idea)}.`,
    plot: drawn,
    more: [
      lines,
      element(
        "p",
        { class: "faint" },
        [
          sweep.by_snapping ? "To fail is to err more than rounding to 1/256 px does by itself." : "",
          sweep.note,
          before.length ? `Thin grey: ${view.other.name}.` : "",
        ]
          .filter(Boolean)
          .join(" "),
      ),
      folded(
        `stability ${sweep.name}`,
        "Figures",
        table(
          `${sweep.name}: ${sweep.y}`,
          [
            [`${sweep.x.name}${unit}`, (row) => row.x],
            ...curves.map((curve) => [curve.names, (row) => curve.points[row.at]?.[2]]),
          ],
          curves[0].points.map(([x], at) => ({ x, at })),
        ),
      ),
    ],
  });
}

// Ours in bold.
function namesOf({ methods }) {
  return methods.flatMap(([name, ours], i) => [i ? ", " : "", ours ? element("b", {}, name) : name]);
}

function powers([low, high], width) {
  const [first, last] = [Math.ceil(Math.log10(low) - 1e-9), Math.floor(Math.log10(high) + 1e-9)];
  const step = Math.max(1, Math.ceil((last - first) / (width / 55)));
  return Array.from({ length: Math.floor((last - first) / step) + 1 }, (_, i) => 10 ** (first + i * step));
}

const raised = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };

function power(value) {
  if (value >= 1e-3 && value < 1e4) return short(value);
  return `10${[...String(Math.round(Math.log10(value)))].map((digit) => raised[digit]).join("")}`;
}
