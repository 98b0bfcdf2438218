// Rows that became faster or slower between two results, as scripts/compare judges them.
import { element, table } from "./page.js";

const most = 60;

export function changes(view) {
  if (!view.other || view.other === view.result) return [];
  const { scene } = view.state;
  const parts = (name) => name.split("/");
  const threads = (name) => Number(/threads:(\d+)/.exec(name)?.[1] ?? 1);
  const rows = view.result.changes[view.data.results.indexOf(view.other)].filter(
    ([name]) => (!scene || parts(name)[1] === scene) && view.threads.includes(threads(name)),
  );
  const clear = rows.filter(([, , , , said]) => said === "faster" || said === "slower");
  const count = (word) => clear.filter((row) => row[4] === word).length;
  return [
    element(
      "p",
      {},
      `From ${view.other.name} to ${view.result.name}: ${rows.length} rows compared, ${count("faster")} faster, ${count("slower")} slower; ` +
        "the others differ by less than 3 %, or by no more than their repetitions do." +
        (clear.length > most ? ` The ${most} largest changes:` : ""),
    ),
    ...(clear.length
      ? [
          table(
            "Rows that changed",
            [
              ["row", ([name]) => name],
              ["ms before", (row) => row[1]],
              ["ms after", (row) => row[2]],
              ["ratio", (row) => row[3]],
              ["verdict", (row) => row[4]],
            ],
            clear.slice(0, most),
          ),
        ]
      : []),
  ];
}
