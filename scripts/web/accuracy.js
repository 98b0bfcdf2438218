// Speed against accuracy on one scene, and the errors of each method on each scene, with links to pictures of the errors.
import * as Plot from "@observablehq/plot";
import { group } from "d3";
import { labels } from "./labels.js";
import { gridAt, kindLook, legend, logTicks, methodLook, plot, sample, tip, zeroScale } from "./look.js";
import { chart, element, number, short, wide } from "./page.js";
import { pictureOf, showPictures } from "./pictures.js";

export function accuracy(view) {
  const { family } = view.state;
  const scenes = view.result.speed.filter((scene) => scene.family === family);
  const scene = scenes.find(({ scene }) => scene === view.state.speedScene) ?? scenes[0];
  const parts = [];
  if (scene) parts.push(sceneFilter(view, scenes, scene), speedChart(view, scene));
  if (view.result.errors[family]?.length) parts.push(errorTable(view, family));
  return parts;
}

function sceneFilter(view, scenes, chosen) {
  const select = element(
    "select",
    { name: "speedScene" },
    ...scenes.map(({ scene, idea }) => element("option", { value: scene }, `${scene}: ${idea}`)),
  );
  select.value = chosen.scene;
  select.addEventListener("change", () => {
    view.state.speedScene = select.value;
    view.redraw();
    document.querySelector("select[name=speedScene]").focus();
  });
  return element("label", {}, "Scene on which methods are timed", select);
}

// One row for each method and number of threads.
function timed(view, result, scene) {
  const methods = new Map(result.methods[scene.family].map((method) => [method.name, method]));
  return scene.points.flatMap((point) =>
    Object.entries(point.costs)
      .filter(([threads]) => view.threads.includes(Number(threads)))
      .map(([threads, [ns, low, high, mtri]]) => ({
        ...point,
        ...methods.get(point.method),
        threads: Number(threads),
        ns,
        low,
        high,
        mtri,
      })),
  );
}

function speedChart(view, scene) {
  const { family } = scene;
  const facts = view.data.families[family];
  const rows = timed(view, view.result, scene);
  const before = view.other?.speed.find((s) => s.family === family && s.scene === scene.scene);
  const rowsBefore = before ? timed(view, view.other, before) : [];
  const moved = rows.flatMap((row) =>
    rowsBefore.filter((b) => b.method === row.method && b.threads === row.threads).map((b) => ({ ...row, before: b })),
  );
  const look = (row) => methodLook(view, family, row);
  const colour = { value: (row) => look(row).colour, scale: null };
  const front = view.threads.includes(1) ? scene.front : [];
  const joined = [...group(rows, (row) => row.method).values()];
  const named = [...rows].sort((a, b) => (b.threads === 1) - (a.threads === 1) || b.ours - a.ours);
  const drawn = plot(
    {
      width: view.width,
      height: Math.min(560, Math.max(380, view.width * 0.55)),
      marginLeft: 52,
      marginRight: 14,
      marginBottom: 46,
      marginTop: 24,
      x: zeroScale(scene.axis, facts.errors),
      y: { type: "log", domain: scene.costs, label: facts.cost, ticks: logTicks(scene.costs), tickFormat: short },
      marks: [
        Plot.rect([scene.axis], { x1: "start", x2: "end", fill: "var(--band)" }),
        gridAt(
          "x",
          scene.axis.ticks.map(([place]) => place),
        ),
        gridAt("y", logTicks(scene.costs)),
        Plot.line(front, { stroke: "var(--ink)", strokeDasharray: "5,3", strokeWidth: 1.2, clip: true }),
        Plot.ruleX(rows, { x: "x", y1: "low", y2: "high", stroke: colour, strokeWidth: 4, strokeOpacity: 0.35 }),
        joined.map((pair) => Plot.line(pair, { x: "x", y: "ns", stroke: look(pair[0]).colour, strokeWidth: 1 })),
        Plot.link(moved, {
          x1: (m) => m.before.x,
          y1: (m) => m.before.ns,
          x2: "x",
          y2: "ns",
          stroke: "var(--faint)",
          strokeWidth: 1,
        }),
        Plot.dot(rowsBefore, {
          x: "x",
          y: "ns",
          fill: "var(--paper)",
          stroke: colour,
          strokeOpacity: 0.5,
          symbol: (row) => look(row).symbol,
          r: 4,
        }),
        Plot.dot(
          rows.filter((row) => row.unsettled && row.threads === 1),
          { x: "x", y: "ns", r: 9, stroke: "var(--ink)" },
        ),
        Plot.dot(rows, {
          x: "x",
          y: "ns",
          r: (row) => (row.threads === 1 ? 5.5 : 4),
          symbol: (row) => look(row).symbol,
          strokeWidth: 1.5,
          stroke: colour,
          fill: { value: (row) => (row.hollow ? "var(--paper)" : look(row).colour), scale: null },
        }),
        labels(
          named.map((row) => ({
            x: row.x,
            y: row.ns,
            bold: row.ours && row.threads === 1,
            text: row.threads === 1 ? row.method : `${row.method}, ${row.threads} threads`,
            colour: row.threads === 1 ? "var(--ink)" : "var(--faint)",
          })),
          {
            points: rows.map((row) => [row.x, row.ns]),
            lines: [
              front,
              ...rows.map((row) => [
                [row.x, row.low],
                [row.x, row.high],
              ]),
            ],
          },
        ),
        tip(rows, { x: "x", y: "ns", says: (row) => says(row, facts, moved) }),
      ],
      r: { type: "identity" },
    },
    (row) => showPictures(view, family, row.method),
  );
  return chart({
    title: `${family}: ${scene.scene}`,
    plot: drawn,
    legend: kindsLegend(view, family, rows, before),
    text: `${facts.idea} Here: ${scene.idea}; ${short(scene.trials)} ${facts.trials}.`,
    figures: [
      [
        ["method", (row) => row.method],
        ["as in", (row) => row.source],
        ["threads", (row) => row.threads],
        [facts.errors, (row) => row.said],
        [facts.cost, (row) => row.ns],
        ["fastest", (row) => row.low],
        ["slowest", (row) => row.high],
        ["10⁶ triangles/s", (row) => row.mtri],
        ["pictures", (row) => pictureButton(view, family, row.method)],
      ],
      rows,
    ],
  });
}

function says(row, facts, moved) {
  const before = moved.find((m) => m.method === row.method && m.threads === row.threads)?.before;
  return [
    `${row.method}, ${row.threads} thread${row.threads > 1 ? "s" : ""}`,
    row.source,
    row.promise,
    `${row.said} ${facts.errors}`,
    `${number(row.ns)} ${facts.cost} (${number(row.low)} to ${number(row.high)})`,
    before && `the other: ${number(before.ns)} ${facts.cost}`,
    row.unsettled && "ranges overlap: the faster one is not settled",
  ];
}

function kindsLegend(view, family, rows, before) {
  const kinds = new Map(
    rows.map((row) => [row.method in view.data.looks.backends ? row.method : row.kind, methodLook(view, family, row)]),
  );
  const names = { ours: "ours", other: "others" };
  const ink = { colour: "var(--faint)", symbol: kindLook(view, family, "ours").symbol };
  const items = [...kinds].map(([kind, look]) => [
    sample(look),
    names[kind] ?? kind,
    kind === "ours" || kind in view.data.looks.backends,
  ]);
  if (rows.some((row) => row.hollow))
    items.push([sample(ink, { hollow: true }), "hollow: errs even given the snapped positions"]);
  if (rows.some((row) => row.unsettled))
    items.push([sample({ colour: "var(--ink)", symbol: ink.symbol }, { hollow: true }), "ringed: not settled"]);
  if (before) items.push([sample(ink, { hollow: true }), `pale, joined by a line: ${view.other.name}`]);
  return legend(items);
}

function pictureButton(view, family, method) {
  const button = element("button", { type: "button" }, "show");
  button.addEventListener("click", () => showPictures(view, family, method));
  return button;
}

function errorTable(view, family) {
  const methods = view.result.methods[family];
  const rows = view.result.errors[family].map(({ scene, cells }) =>
    element(
      "tr",
      {},
      element("th", { scope: "row" }, scene),
      ...methods.map(({ name }) => errorCell(view, family, scene, name, cells[name])),
    ),
  );
  const head = methods.map(({ name, ours }) =>
    element("th", { scope: "col", ...(ours ? { class: "ours" } : {}) }, name),
  );
  const title = `Where each method errs: ${view.data.families[family].errors}`;
  return element(
    "figure",
    {},
    element(
      "figcaption",
      {},
      element("h3", {}, title),
      element("p", {}, "Scene by scene; underlined figures open a picture of the errors."),
    ),
    wide(
      title,
      element(
        "table",
        { class: "matrix" },
        element("thead", {}, element("tr", {}, element("td"), ...head)),
        element("tbody", {}, ...rows),
      ),
    ),
  );
}

function errorCell(view, family, scene, method, cell) {
  if (!cell) return element("td");
  const [text, shade] = cell;
  const made = element("td", { style: `background: rgba(var(--shade), ${0.75 * shade})` });
  if (pictureOf(view, family, scene, method) === undefined) {
    made.append(text);
    return made;
  }
  const button = element(
    "button",
    { type: "button", "aria-label": `${method} on ${scene}: ${text}; show the picture` },
    text,
  );
  button.addEventListener("click", () => showPictures(view, family, method, scene));
  made.append(button);
  return made;
}
