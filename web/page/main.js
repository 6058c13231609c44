// Puts the page together: makes the parts and tells each what it must know of the others. The first module that
// index.html loads; holds no logic of its own beyond who hears of what.
import { Drawing } from "./draw/drawing.js";
import { wanderingPlace } from "./draw/lantern.js";
import { MATERIALS } from "./draw/materials.js";
import { Pen } from "./draw/pen.js";
import { Backends, whyNoWebgpu } from "./light/backends.js";
import { Loop } from "./light/loop.js";
import { Truth } from "./light/truth.js";
import { Overlay } from "./look/overlay.js";
import { Screen } from "./look/screen.js";
import { Messages } from "./ui/announce.js";
import { bindControls } from "./ui/controls.js";
import { bindFiles } from "./ui/file_dialogs.js";
import { bindKeyboard } from "./ui/keyboard.js";
import { Panel } from "./ui/panel.js";
import { bindPointer } from "./ui/pointer.js";
import { ScenePicker } from "./ui/scene_picker.js";
import { Settings } from "./ui/settings.js";
import { bindSwatches } from "./ui/swatches.js";
import { TruthPanel } from "./ui/truth_panel.js";

/** Settings whose change asks for another solve, with or without a lantern, and those of looking alone. */
const SOLVES_ANEW = ["backend", "solver", "bounces", "merge", "skip", "bound", "rays", "shadow", "cell", "falloff", "range"];
const CHANGES_LANTERN = ["tool", "wander", "colour", "radius", "brightness"];
const LOOKS = ["view", "exposure"];
/** The truth is traced again when nobody has drawn for so long [ms]. */
const TRUTH_PAUSE = 600;
/** A solve that takes longer than this has a bar [ms]. */
const LONG = 400;

const find = (id) => document.querySelector(`#${id}`);
const picture = find("picture");

const settings = new Settings();
settings.readAddress(location.hash);
const messages = new Messages(document);
const drawing = new Drawing();
const pen = new Pen(drawing, () => settings.brush());
const backends = new Backends();
const truth = new Truth();
const overlay = new Overlay(find("overlay"));
const panel = new Panel(document);
const scenes = new ScenePicker(document, settings, drawing, messages, () => backends.get("wasm"));

/** Where the lantern was last carried to; it stays there while the pen is elsewhere. */
let lantern = null;
let keyboardMoves = false;

function wanders() {
  return settings.get("tool") === "carry" && settings.get("wander");
}

function lanternAt(now) {
  if (wanders()) return wanderingPlace(now, drawing.world.width);
  return settings.get("tool") === "carry" ? lantern : null;
}

const loop = new Loop({
  drawing,
  settings,
  backends,
  lanternAt,
  wanders,
  screen: new Screen(picture, find("glow")),
  truth: () => truth.light,
});

// Drawing -----------------------------------------------------------------------------------------------------

function showPen() {
  overlay.show(pen, settings, keyboardMoves);
}

pen.addEventListener("move", () => {
  if (pen.at && settings.get("tool") === "carry") {
    lantern = pen.at;
    loop.solve();
    forgetTruth();
  }
  showPen();
});

drawing.addEventListener("change", () => {
  find("undo").disabled = !drawing.canUndo;
  find("redo").disabled = !drawing.canRedo;
  if (drawing.world.width !== settings.get("size")) settings.set("size", drawing.world.width);
  if (lantern?.some((value) => value > drawing.world.width)) lantern = null;
  loop.solve();
  forgetTruth();
});

function undo() {
  const name = drawing.undo();
  messages.say(name ? `Undone: ${name}.` : "Nothing to undo.");
}

function redo() {
  const name = drawing.redo();
  messages.say(name ? `Done again: ${name}.` : "Nothing to do again.");
}

/** What a reader hears where the keyboard's cursor is. */
function sayPlace() {
  keyboardMoves = true;
  showPen();
  const [x, y] = pen.at.map((value) => Math.min(Math.floor(value), drawing.world.width - 1));
  messages.sayLater(`${x}, ${y}: ${drawing.world.nameOf(y * drawing.world.width + x)}`);
}

// Truth -------------------------------------------------------------------------------------------------------

let truthTimer = 0;
const truthPanel = new TruthPanel(document, truth, startTruth);

function startTruth() {
  clearTimeout(truthTimer);
  truth.start(loop.litWorld(), settings.solveTruth(), loop.litLights());
}

/** The picture is another one: in the difference view a new truth follows as soon as nothing moves. */
function forgetTruth() {
  clearTimeout(truthTimer);
  truth.forget();
  if (settings.get("view") === "difference" && !wanders()) truthTimer = setTimeout(startTruth, TRUTH_PAUSE);
}

truth.addEventListener("change", () => {
  truthPanel.show(loop.last?.solution.light ?? null);
  loop.paint();
});

// Light -------------------------------------------------------------------------------------------------------

loop.addEventListener("solved", () => {
  find("solve-progress").hidden = true;
  if (truth.state === "done") truthPanel.show(loop.last.solution.light);
});
loop.addEventListener("painted", () => {
  showPen();
  if (!loop.last) return;
  panel.show(loop.last); // not before: it says how long painting took
  if (document.documentElement.dataset.state !== "ready") becomeReady(); // nor this: now the light is to be seen
});
loop.addEventListener("busy", () => picture.setAttribute("aria-busy", String(loop.busy)));
loop.addEventListener("progress", ({ detail: { done, ms } }) => {
  const bar = find("solve-progress");
  bar.hidden = ms < LONG;
  bar.firstElementChild.value = done;
});
loop.addEventListener("failed", (event) => backendFailed(event.detail));

function becomeReady() {
  find("not-started").hidden = true;
  document.documentElement.dataset.state = "ready";
  performance.mark("dapple-ready");
  lookForWebgpu(); // not before: starting the graphics process would hold up the first picture
  messages.say("Move over the picture to carry a lamp; click to leave it there.");
}

function backendFailed(error) {
  find("solve-progress").hidden = true;
  if (settings.get("backend") === "webgpu") {
    messages.notice(`WebGPU cannot be used (${error.message}). The CPU goes on; the drawing is as it was.`);
    settings.set("backend", "wasm");
  } else messages.notice(`The light could not be computed: ${error.message}`);
}

backends.addEventListener("lost", ({ detail: { name, reason } }) => {
  const words = name === "webgpu" ? "The graphics device was lost" : "The worker was lost";
  messages.notice(`${words} (${reason}). The CPU goes on; the drawing is as it was.`);
  settings.set("backend", "wasm");
  loop.restart();
});

async function lookForWebgpu() {
  const why = await whyNoWebgpu();
  if (!why) return;
  find("webgpu-option").disabled = true;
  find("webgpu-note").hidden = false;
  find("webgpu-note").textContent = `${why} Everything runs on the CPU instead.`;
  if (settings.get("backend") !== "webgpu") return;
  messages.notice(`${why} The CPU computes the light instead.`);
  settings.set("backend", "wasm");
}

// Settings ----------------------------------------------------------------------------------------------------

function showAmounts() {
  const { material } = settings.brush();
  const { amount } = MATERIALS[material];
  find("brightness-field").hidden = amount !== "brightness";
  find("density-field").hidden = amount !== "density";
  find("colour-field").hidden = material === "eraser";
}

settings.addEventListener("change", ({ detail: name }) => {
  scenes.changed(name);
  showAmounts();
  if (SOLVES_ANEW.includes(name)) loop.restart();
  if (CHANGES_LANTERN.includes(name)) loop.solve();
  if (LOOKS.includes(name)) loop.paint();
  if (["truth", "bounces", "tool", "solver"].includes(name)) forgetTruth();
  if (name === "view" && settings.get("view") === "difference" && truth.state === "none") startTruth();
  if (settings.isShared(name)) history.replaceState(null, "", `#${settings.address()}`);
});
window.addEventListener("hashchange", () => settings.readAddress(location.hash));

async function copyLink() {
  try {
    await navigator.clipboard.writeText(location.href);
    messages.say("The link is copied: scene, method and view, not what you drew.");
  } catch {
    messages.say(`Copy this address: ${location.href}`);
  }
}

let benchmark = null;

/** Loaded when it is first asked for. */
async function openBenchmark() {
  const { Benchmark } = await import("./benchmark/dialog.js");
  benchmark ??= new Benchmark(find("benchmark-dialog"));
  benchmark.open();
}

// Begin -------------------------------------------------------------------------------------------------------

bindControls(document, settings);
bindSwatches(find("swatches"), settings);
bindPointer(picture, pen);
picture.addEventListener("pointermove", () => (keyboardMoves = false));
bindKeyboard({
  canvas: picture,
  pen,
  settings,
  undo,
  redo,
  moved: sayPlace,
  help: () => find("help-dialog").showModal(),
});
bindFiles(document, drawing, messages);
find("undo").addEventListener("click", undo);
find("redo").addEventListener("click", redo);
find("share").addEventListener("click", copyLink);
find("benchmark-open").addEventListener("click", openBenchmark);
find("help-open").addEventListener("click", () => find("help-dialog").showModal());
showAmounts();
scenes.load(true);
