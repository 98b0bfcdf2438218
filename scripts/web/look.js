// The colours and marks of the static charts, and functions that all charts share.
import { symbol, symbolCircle, symbolCross, symbolDiamond2, symbolSquare, symbolTriangle, symbolX } from "d3";
import * as Plot from "@observablehq/plot";
import { element } from "./page.js";

const pointsDown = {
  draw(context, size) {
    symbolTriangle.draw(
      {
        moveTo: (x, y) => context.moveTo(x, -y),
        lineTo: (x, y) => context.lineTo(x, -y),
        closePath: () => context.closePath(),
      },
      size,
    );
  },
};
export const circle = symbolCircle;
const symbols = {
  o: circle,
  s: symbolSquare,
  "^": symbolTriangle,
  D: symbolDiamond2,
  v: pointsDown,
  P: symbolCross,
  X: symbolX,
};

// Of an estimate: upright, as high as a mark of its size is wide.
export const bar = {
  draw(context, size) {
    const half = Math.sqrt(size / Math.PI);
    context.moveTo(0, -half);
    context.lineTo(0, half);
  },
};

// Black is the ink: white in the dark.
const colour = (value) => (value === "#000000" ? "var(--ink)" : value);

// Of a text: nearer to the ink, so that it can be read on the paper.
export const asText = (value) => `color-mix(in srgb, ${value} 60%, var(--ink))`;

export function backendLook(view, backend) {
  const [value, marker] = view.data.looks.backends[backend];
  return { colour: colour(value), symbol: symbols[marker] };
}

export function kindLook(view, family, kind) {
  const [value, marker] = view.data.looks.kinds[family][kind];
  return { colour: colour(value), symbol: symbols[marker] };
}

// Of the methods of coverage, ours are the backends.
export const methodLook = (view, family, { method, kind }) =>
  method in view.data.looks.backends ? backendLook(view, method) : kindLook(view, family, kind);

export const verdictColour = (view, verdict) => colour(view.data.looks.verdicts[verdict] ?? "var(--ink)");

// Of a line and a mark, as they stand in legends.
export function sample(look, { hollow = false, dash = null, width = 16 } = {}) {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  const parts = [];
  if (dash)
    parts.push([
      "M0,6H" + width,
      { stroke: look.colour, "stroke-width": 2, "stroke-dasharray": dash.map((n) => 2 * n).join(" ") },
    ]);
  if (look.symbol) {
    parts.push([
      symbol(look.symbol, 50)(),
      {
        transform: `translate(${width / 2},6)`,
        stroke: look.colour,
        "stroke-width": 1.5,
        fill: hollow ? "var(--paper)" : look.colour,
      },
    ]);
  }
  for (const [name, value] of Object.entries({ width, height: 12, "aria-hidden": "true" }))
    svg.setAttribute(name, value);
  for (const [d, attributes] of parts) {
    const path = document.createElementNS(svg.namespaceURI, "path");
    for (const [name, value] of Object.entries({ fill: "none", ...attributes, d })) path.setAttribute(name, value);
    svg.append(path);
  }
  return svg;
}

// items: [sample, text, whether it is ours]
export function legend(items) {
  return element(
    "ul",
    { class: "legend" },
    ...items.map(([drawn, text, ours]) => element("li", ours ? { class: "ours" } : {}, drawn, ` ${text}`)),
  );
}

export function backendLegend(view, backends = view.result.backends) {
  return legend(backends.map((name) => [sample(backendLook(view, name)), name]));
}

// A plot in the page's ink; `click` gets the datum under the pointer.
export function plot(options, click) {
  const drawn = Plot.plot({
    ...options,
    style: { background: "none", color: "var(--ink)", fontSize: "12px", overflow: "visible" },
  });
  if (click) {
    drawn.classList.add("clickable");
    drawn.addEventListener("click", () => drawn.value && click(drawn.value));
  }
  return drawn;
}

// What is read when a mark is pointed at: `says` gives lines of text.
export function tip(rows, { x, y, says }) {
  return Plot.tip(
    rows,
    Plot.pointer({
      x,
      y,
      title: (row) => says(row).filter(Boolean).join("\n"),
      lineWidth: 30,
      fontSize: 12,
      stroke: "var(--line)",
      textPadding: 8,
      maxRadius: 40,
    }),
  );
}

const gridLine = { stroke: "var(--grid)", strokeOpacity: 1 };
export const gridAt = (axis, ticks) => (axis === "x" ? Plot.gridX : Plot.gridY)(ticks, gridLine);

// An axis that begins with a band for 0; places on it come with the figures.
export function zeroScale(axis, label) {
  const texts = new Map(axis.ticks);
  return {
    domain: [axis.start, axis.limit],
    ticks: axis.ticks.map(([place]) => place),
    tickFormat: (place) => texts.get(place),
    label,
  };
}

// Powers of ten; where these are less than two, what lies between them.
export function decades(domain) {
  const ticks = logTicks(domain);
  const powers = ticks.filter((tick) => Number.isInteger(Math.log10(tick)));
  return powers.length > 1 ? powers : ticks;
}

// Powers of ten, and what lies between them where there are few.
export function logTicks([low, high]) {
  const steps = high / low > 1000 ? [1] : high / low > 12 ? [1, 2, 5] : [1, 1.5, 2, 3, 4, 5, 7];
  const ticks = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); ++power) {
    for (const step of steps) {
      const tick = Number((step * 10 ** power).toPrecision(3));
      if (tick >= low && tick <= high) ticks.push(tick);
    }
  }
  return ticks;
}
