// The filters above the charts; what is chosen stands in the address too, so that a link leads to the same view.
import { element } from "./page.js";

const start = { result: "0", other: "", threads: "", family: "coverage", scene: "" };

export function filters(form, data, changed) {
  const state = { ...start };
  for (const [key, value] of new URLSearchParams(location.hash.slice(1))) if (key in start) state[key] = value;

  const results = data.results.map(({ name }, index) => [String(index), name]);
  const scenes = [...new Set(data.results.flatMap((result) => result.scenes))];
  const choices = {
    result: ["Machine and commit", results],
    other: ["Compare with", [["", "nothing"], ...results]],
    threads: [
      "Threads",
      [
        ["", "1 and 2"],
        ["1", "1"],
        ["2", "2"],
      ],
    ],
    family: ["Family of methods", Object.keys(data.families).map((name) => [name, name])],
    scene: ["Scene", [["", "all"], ...scenes.map((name) => [name, name])]],
  };
  for (const [key, [label, options]] of Object.entries(choices)) {
    if (!options.some(([value]) => value === state[key])) state[key] = start[key];
    if (options.length < 2 || (key === "other" && results.length < 2)) continue;
    const select = element(
      "select",
      { name: key },
      ...options.map(([value, text]) => element("option", { value }, text)),
    );
    select.value = state[key];
    select.addEventListener("change", () => {
      state[key] = select.value;
      const chosen = Object.entries(state).filter(([name, value]) => value !== start[name]);
      history.replaceState(null, "", `#${new URLSearchParams(chosen)}`);
      changed();
    });
    form.append(element("label", {}, label, select));
  }
  form.addEventListener("submit", (event) => event.preventDefault());
  new ResizeObserver(() => tellHeight(form)).observe(form);
  tellHeight(form);
  return state;
}

// While the filters stay on top, links must scroll their targets below them.
function tellHeight(form) {
  const height = getComputedStyle(form).position === "sticky" ? form.offsetHeight : 0;
  document.documentElement.style.setProperty("--filters-height", `${height}px`);
}
