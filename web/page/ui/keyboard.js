// The keyboard: arrows move a cursor on the picture and space paints; single letters pick tools while the
// picture has the focus; a few keys work everywhere. Called by main.

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/** What a letter sets while the picture has the focus: [setting, value]. */
const LETTERS = {
  m: ["tool", "carry"],
  b: ["tool", "brush"],
  l: ["tool", "line"],
  r: ["tool", "rectangle"],
  c: ["tool", "circle"],
  1: ["material", "lamp"],
  2: ["material", "wall"],
  3: ["material", "glass"],
  4: ["material", "fog"],
  5: ["material", "eraser"],
};

const VIEW_ORDER = ["light", "lit", "emission", "walls", "difference"];

function nextOf(list, value) {
  return list[(list.indexOf(value) + 1) % list.length];
}

function isTyping(target) {
  return target.matches("input:not([type=radio], [type=checkbox], [type=range]), textarea, select");
}

/** parts: { canvas, pen, settings, undo, redo, help, moved }; moved() is told when the cursor moved by key. */
export function bindKeyboard(parts) {
  const { canvas, pen } = parts;
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (onPicture(event, parts)) event.preventDefault();
  });
  canvas.addEventListener("keyup", (event) => {
    if (event.key === " " && !pen.stretches) pen.up();
  });
  canvas.addEventListener("blur", () => pen.cancel());
  document.addEventListener("keydown", (event) => {
    if (anywhere(event, parts)) event.preventDefault();
    else if (event.key === "?" && !isTyping(event.target)) parts.help();
  });
}

function onPicture(event, { canvas, pen, settings, moved }) {
  const arrow = ARROWS[event.key];
  if (arrow) {
    const step = (event.shiftKey ? 1 : 4) * (settings.get("size") / 256);
    const from = pen.at ?? [canvas.width / 2, canvas.height / 2];
    pen.move([clamp(from[0] + arrow[0] * step, canvas.width), clamp(from[1] + arrow[1] * step, canvas.height)]);
    moved();
    return true;
  }
  if (event.key === " " || event.key === "Enter") {
    if (event.repeat) return true;
    const at = pen.at ?? [canvas.width / 2, canvas.height / 2];
    if (pen.isDown && pen.stretches) pen.up();
    else pen.down(at);
    if (event.key === "Enter" && !pen.stretches) pen.up();
    moved();
    return true;
  }
  if (event.key === "Escape" && pen.isDown) {
    pen.cancel();
    return true;
  }
  return letter(event.key.toLowerCase(), settings);
}

function letter(key, settings) {
  if (key in LETTERS) settings.set(...LETTERS[key]);
  else if (key === "v") settings.set("view", nextOf(VIEW_ORDER, settings.get("view")));
  else if (key === "d") settings.set("view", settings.get("view") === "difference" ? "light" : "difference");
  else if (key === "[") settings.set("radius", Math.max(settings.get("radius") - 1, 1));
  else if (key === "]") settings.set("radius", Math.min(settings.get("radius") + 1, 64));
  else return false;
  return true;
}

function anywhere(event, { undo, redo }) {
  if (!(event.ctrlKey || event.metaKey) || isTyping(event.target)) return false;
  const key = event.key.toLowerCase();
  if (key === "z") (event.shiftKey ? redo : undo)();
  else if (key === "y") redo();
  else return false;
  return true;
}

function clamp(value, size) {
  return Math.min(Math.max(value, 0), size);
}
