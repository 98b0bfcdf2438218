// The report: reads the figures embedded in the page, and draws every section anew when a filter or the width changes.
import { accuracy } from "./accuracy.js";
import { area } from "./area.js";
import { changes } from "./changes.js";
import { filters } from "./filters.js";
import { ablation } from "./ablation.js";
import { peers } from "./peers.js";
import { scaling } from "./scaling.js";
import { stability } from "./stability.js";

const sections = { accuracy, area, ablation, stability, peers, scaling, changes };
const data = JSON.parse(document.getElementById("data").textContent);
const state = filters(document.getElementById("filters"), data, () => draw());

const pageOfPaper = 720; // px: as wide as text is printed, so that it isn't shrunk

function draw(wanted) {
  const result = data.results[state.result];
  const other = data.results[state.other] ?? null;
  const threads = state.threads ? [Number(state.threads)] : [1, 2];
  document.getElementById("machine").textContent =
    `${result.machine}.` + (other ? ` Compared with ${other.name}: ${other.machine}.` : "");
  document.querySelectorAll("[data-findings]").forEach((list, index) => (list.hidden = index !== Number(state.result)));
  for (const holder of document.querySelectorAll("[data-charts]")) {
    const width = wanted ?? holder.clientWidth;
    const view = { data, state, result, other, threads, width, redraw: () => draw() };
    const open = [...holder.querySelectorAll("details[open]")].map((details) => details.dataset.key);
    const drawn = sections[holder.dataset.charts](view);
    holder.replaceChildren(...(drawn.length ? drawn : [nothing()]));
    for (const details of holder.querySelectorAll("details")) details.open = open.includes(details.dataset.key);
  }
}

function nothing() {
  const text = document.createElement("p");
  text.textContent = "These results hold nothing of this.";
  return text;
}

let drawnAt = innerWidth;
addEventListener("resize", () => {
  if (innerWidth !== drawnAt) {
    drawnAt = innerWidth;
    draw();
  }
});
addEventListener("beforeprint", () => draw(pageOfPaper));
addEventListener("afterprint", () => draw());
draw();
// The browser scrolled there before the charts took their room.
document.getElementById(location.hash.slice(1))?.scrollIntoView();
