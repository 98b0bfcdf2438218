// Filters and sorts the table of benchmark rows. Without JavaScript the table shows all rows in the order of the benchmark.
"use strict";
const body = document.querySelector("#rows tbody");
const rows = [...body.rows].map((element) => ({
  element,
  words: [...element.cells].map((cell) => cell.textContent.toLowerCase()).join(" "),
}));

const filter = document.querySelector("#filter");
const [input, count] = filter.querySelectorAll("input, output");
function show() {
  const words = input.value.toLowerCase().split(/\s+/);
  for (const row of rows) row.element.hidden = !words.every((word) => row.words.includes(word));
  count.value = `${rows.filter((row) => !row.element.hidden).length} of ${rows.length} rows`;
}
input.addEventListener("input", show);
filter.hidden = false;
show();

// A cell's number, or else its text; null sorts last in both directions.
function value(row, column) {
  const {dataset, textContent} = row.element.cells[column];
  if (dataset.value === undefined) return textContent || null;
  return dataset.value === "" ? null : Number(dataset.value);
}

function sort(heading, column) {
  const down = heading.getAttribute("aria-sort") === "ascending";
  for (const other of heading.parentElement.cells) other.removeAttribute("aria-sort");
  heading.setAttribute("aria-sort", down ? "descending" : "ascending");
  rows.sort((a, b) => {
    const [x, y] = [value(a, column), value(b, column)];
    if (x === null || y === null) return (x === null) - (y === null);
    const order = typeof x === "number" ? x - y : x.localeCompare(y, "en", {numeric: true});
    return down ? -order : order;
  });
  body.append(...rows.map((row) => row.element));
}

[...document.querySelectorAll("#rows th")].forEach((heading, column) => {
  const button = document.createElement("button");
  button.type = "button";
  button.append(...heading.childNodes);
  button.addEventListener("click", () => sort(heading, column));
  heading.append(button);
});
