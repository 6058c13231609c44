// What lies over the picture and is not part of it: the ring of the brush, the outline of a shape being drawn,
// the cross of the keyboard. Called by main; drawn as SVG in pixels of the picture.

const SVG = "http://www.w3.org/2000/svg";

function element(name, attributes) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  return made;
}

const OUTLINES = {
  line: ([ax, ay], [bx, by]) => element("line", { x1: ax, y1: ay, x2: bx, y2: by }),
  rectangle: ([ax, ay], [bx, by]) =>
    element("rect", { x: Math.min(ax, bx), y: Math.min(ay, by), width: Math.abs(bx - ax), height: Math.abs(by - ay) }),
  circle: ([ax, ay], [bx, by]) => element("circle", { cx: ax, cy: ay, r: Math.hypot(bx - ax, by - ay) }),
};

function cross([x, y], size) {
  const reach = 6 * size;
  return element("path", { d: `M${x - reach},${y}h${2 * reach}M${x},${y - reach}v${2 * reach}` });
}

export class Overlay {
  #svg;

  constructor(svg) {
    this.#svg = svg;
  }

  /** Shows the pen's place; `keyboard` adds a cross, which is easier to find than a ring. */
  show(pen, settings, keyboard) {
    const size = settings.get("size"),
      unit = size / 256;
    this.#svg.setAttribute("viewBox", `0 0 ${size} ${size}`);
    const parts = [];
    if (pen.at) {
      if (settings.get("tool") !== "carry")
        parts.push(element("circle", { cx: pen.at[0], cy: pen.at[1], r: Math.max(settings.brushSize() / 2, unit) }));
      if (keyboard) parts.push(cross(pen.at, unit));
      const outline = pen.outline;
      if (outline) parts.push(OUTLINES[outline.tool](outline.from, outline.to));
    }
    // Each line twice: dark under light, to be seen on any picture.
    const under = parts.map((part) => part.cloneNode());
    for (const part of under) part.setAttribute("class", "under");
    this.#svg.replaceChildren(...under, ...parts);
  }
}
