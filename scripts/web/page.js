// Parts of the page: elements, charts with their tables of figures, legends. Text is never taken for HTML.
import { format } from "d3";

export function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

const threeDigits = format(",.3~r");
const withUnit = format(".3~s");

export const number = (value) => (Math.abs(value) < 1e-3 && value !== 0 ? value.toPrecision(2) : threeDigits(value));
// 1000 → 1k; small numbers as they are.
export const short = (value) => (Math.abs(value) < 1000 ? number(value) : withUnit(value));

// A table of figures. A column is [title, row → cell]; cells are text, numbers or nodes.
export function table(caption, columns, rows) {
  const cellOf = (value, tag, extra) => {
    const isNumber = typeof value === "number";
    return element(
      tag,
      { ...(isNumber || extra ? { class: "number" } : {}) },
      isNumber ? number(value) : (value ?? "–"),
    );
  };
  const numeric = columns.map(
    ([, cell]) => rows.length > 0 && rows.every((row) => typeof (cell(row) ?? 0) === "number"),
  );
  const head = columns.map(([title], i) => {
    const cell = cellOf(title, "th", numeric[i]);
    cell.scope = "col";
    return cell;
  });
  return wide(
    caption,
    element(
      "table",
      {},
      element("caption", {}, caption),
      element("thead", {}, element("tr", {}, ...head)),
      element(
        "tbody",
        {},
        ...rows.map((row) => element("tr", {}, ...columns.map(([, cell], i) => cellOf(cell(row), "td", numeric[i])))),
      ),
    ),
  );
}

// Wide content scrolls by itself, by keyboard as well.
export function wide(label, child) {
  return element("div", { class: "wide", role: "region", tabindex: "0", "aria-label": label }, child);
}

export function folded(key, summary, ...children) {
  return element("details", { "data-key": key }, element("summary", {}, summary), ...children);
}

// A chart with its title, text, legend and figures.
export function chart({ title, text, legend, plot, figures, more = [] }) {
  plot.setAttribute("role", "img");
  plot.setAttribute("aria-label", `${title}. ${text ?? ""} The figures stand in the table below.`);
  return element(
    "figure",
    {},
    element("figcaption", {}, element("h3", {}, title), ...(text ? [element("p", {}, text)] : [])),
    ...(legend ? [legend] : []),
    plot,
    ...more,
    ...(figures ? [folded(title, "Figures", table(title, ...figures))] : []),
  );
}

// Side by side as many as fit; `draw` gets each item and its width.
export function grid(view, items, least, draw) {
  const gap = 24;
  const columns = Math.max(1, Math.min(items.length, Math.floor((view.width + gap) / (least + gap))));
  const width = Math.min(760, Math.floor((view.width - gap * (columns - 1)) / columns));
  const holder = element("div", {
    class: "charts",
    style: `grid-template-columns: repeat(${columns}, minmax(0, 1fr))`,
  });
  holder.append(...items.map((item) => draw(item, width)));
  return holder;
}
