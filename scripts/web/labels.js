// Names beside points, as a mark for Plot: none on another, on a point, or outside. A name without a place is left out;
// it is read by pointing at its mark.
const distances = [8, 13, 20, 30, 42, 56];
const angles = [0, 25, -25, 50, -50, 180, 155, 205, 130, 230, 75, -75, 105, 255, 90, -90].map(
  (degrees) => (degrees * Math.PI) / 180,
);
const height = 14;
const svgName = "http://www.w3.org/2000/svg";
let measure = null;

export function widthOf(text, bold = false) {
  measure ??= document.createElement("canvas").getContext("2d");
  measure.font = `${bold ? "bold " : ""}12px system-ui, sans-serif`;
  return measure.measureText(text).width + 2;
}

const meet = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
const holds = (box, [x, y], margin) =>
  box.left - margin < x && x < box.right + margin && box.top - margin < y && y < box.bottom + margin;

function along([x0, y0], [x1, y1], step = 4) {
  const count = Math.max(1, Math.round(Math.hypot(x1 - x0, y1 - y0) / step));
  return Array.from({ length: count + 1 }, (_, i) => [x0 + (i / count) * (x1 - x0), y0 + (i / count) * (y1 - y0)]);
}

function* candidates([x, y], wide, high, least) {
  for (const distance of distances.filter((distance) => distance >= least)) {
    for (const angle of angles) {
      const [px, py] = [x + distance * Math.cos(angle), y - distance * Math.sin(angle)];
      const left = Math.cos(angle) > 0.3 ? px : Math.cos(angle) < -0.3 ? px - wide : px - wide / 2;
      const top = py - high / 2 - (high / 2) * Math.sin(angle);
      const box = { left, top, right: left + wide, bottom: top + high };
      yield {
        box,
        end: [Math.min(Math.max(x, box.left), box.right), Math.min(Math.max(y, box.top), box.bottom)],
        distance,
      };
    }
  }
}

// names: {x, y, text (lines), bold, colour, least (distance, px)}, the most important first; keepOff: {points, lines} in the units of the data.
export function labels(names, keepOff) {
  return (_, scales, __, dimensions) => {
    const toPixels = ([x, y]) => [scales.x(x), scales.y(y)];
    const points = keepOff.points.map(toPixels);
    const lines = keepOff.lines.flatMap((line) =>
      line.map(toPixels).flatMap((p, i, all) => (i ? along(all[i - 1], p) : [])),
    );
    const bounds = {
      left: dimensions.marginLeft,
      right: dimensions.width - 2,
      top: dimensions.marginTop - 8,
      bottom: dimensions.height - dimensions.marginBottom,
    };
    const group = document.createElementNS(svgName, "g");
    group.setAttribute("class", "labels");
    const taken = [];
    for (const name of names) {
      const texts = name.text.split("\n");
      const wide = Math.max(...texts.map((text) => widthOf(text, name.bold)));
      const at = toPixels([name.x, name.y]);
      const free = ({ box, end }) =>
        box.left >= bounds.left &&
        box.right <= bounds.right &&
        box.top >= bounds.top &&
        box.bottom <= bounds.bottom &&
        !taken.some((other) => meet(box, other.box)) &&
        !points.some((p) => holds(box, p, 5)) &&
        !taken.some((other) => other.leader.some((p) => holds(box, p, 1))) &&
        !along(at, end).some((p) => taken.some((other) => holds(other.box, p, 1)));
      const all = [...candidates(at, wide, height * texts.length, name.least ?? 0)];
      const place =
        all.find((c) => free(c) && !lines.some((p) => holds(c.box, p, 1))) ??
        all.find((c) => c.distance < 30 && free(c));
      if (!place) continue;
      const long = Math.hypot(place.end[0] - at[0], place.end[1] - at[1]) > 12;
      taken.push({ box: place.box, leader: long ? along(at, place.end) : [] });
      if (long) group.append(leader(at, place.end));
      texts.forEach((text, i) => group.append(label(text, place.box.left, place.box.top + height * (i + 0.75), name)));
    }
    return group;
  };
}

function label(text, x, y, { bold, colour }) {
  const made = document.createElementNS(svgName, "text");
  const attributes = {
    x,
    y,
    fill: colour ?? "var(--ink)",
    "font-size": 12,
    "font-family": "system-ui, sans-serif",
    "pointer-events": "none",
    "text-anchor": "start",
    "font-weight": bold ? "bold" : "normal",
    stroke: "var(--paper)",
    "stroke-width": 3,
    "paint-order": "stroke",
  };
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.textContent = text;
  return made;
}

function leader([x0, y0], [x1, y1]) {
  const made = document.createElementNS(svgName, "line");
  const pull = 6 / Math.hypot(x1 - x0, y1 - y0); // off the mark
  const attributes = {
    x1: x0 + pull * (x1 - x0),
    y1: y0 + pull * (y1 - y0),
    x2: x1,
    y2: y1,
    stroke: "var(--faint)",
    "stroke-width": 0.7,
  };
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  return made;
}
