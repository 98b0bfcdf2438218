// The pictures of a method's errors, in a dialog.
import { element } from "./page.js";

const nameOf = (family, scene, method) => `${family}-${scene}-${method}`;

export function pictureOf(view, family, scene, method) {
  const { named, images } = view.data.pictures;
  const index = view.result === view.data.results[0] ? named[nameOf(family, scene, method)] : undefined;
  return index === undefined ? undefined : images[index];
}

// Of one scene, or of all that have a picture.
export function showPictures(view, family, method, only) {
  const facts = view.result.methods[family].find(({ name }) => name === method);
  const cells = new Map(view.result.errors[family].map(({ scene, cells }) => [scene, cells[method]?.[0]]));
  const scenes = only ? [only] : [...cells.keys(), "turning-cube"];
  const found = scenes.map((scene) => [scene, pictureOf(view, family, scene, method)]).filter(([, image]) => image);
  const close = element("button", { type: "button" }, "Close");
  const dialog = document.getElementById("pictures");
  close.addEventListener("click", () => dialog.close());
  dialog.replaceChildren(
    element("header", {}, element("h2", { id: "pictures-title" }, `${family}: ${method}`), close),
    element("p", { class: "faint" }, [facts?.source, facts?.promise].filter(Boolean).join("; ")),
    element(
      "p",
      {},
      found.length
        ? "Vermilion: nothing was drawn where something must be. Blue: drawn twice, or by the wrong triangle. " +
            "Yellow: another triangle drew it than should have, or it lies on the outline. Purple: drawn where nothing must be."
        : "No picture of this method: it errs in none of the scenes that are small enough for one, or these results have none.",
    ),
    element(
      "div",
      { class: "charts" },
      ...found.map(([scene, image]) =>
        element(
          "figure",
          {},
          element("img", { src: image, alt: `The errors of ${method} on ${scene}` }),
          element(
            "figcaption",
            {},
            element(
              "p",
              {},
              `${scene}${cells.get(scene) ? `: ${cells.get(scene)} ${view.data.families[family].errors}` : ""}`,
            ),
          ),
        ),
      ),
    ),
  );
  dialog.showModal();
}
