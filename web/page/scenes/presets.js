// Start scenes made by code: rooms, pillars, glass and fog, a neon sign, an empty floor. Called by scene_list.js.
// Coordinates are those of a picture of 256 px and grow with it.
import { materialOf } from "../draw/materials.js";
import * as shapes from "../draw/shapes.js";
import { World } from "../draw/world.js";
import { paintFloor } from "./floors.js";
import { linesOfText, widthOfText } from "./letters.js";

/** A world and the few things a scene is built of, in units of 1/256 of its size. */
class Builder {
  constructor(size, floor, sky) {
    this.world = new World(size, size);
    this.unit = size / 256;
    this.world.sky = sky;
    paintFloor(this.world, floor);
  }

  #put(shape, brush) {
    this.world.stamp(shape, materialOf({ brightness: 1, density: 1, ...brush }));
  }

  #at([x, y]) {
    return [x * this.unit, y * this.unit];
  }

  line(from, to, width, brush) {
    this.#put(shapes.capsule(this.#at(from), this.#at(to), (width / 2) * this.unit), brush);
  }

  box(from, to, brush) {
    this.#put(shapes.box(this.#at(from), this.#at(to)), brush);
  }

  disc(at, radius, brush) {
    this.#put(shapes.disc(...this.#at(at), radius * this.unit), brush);
  }

  ring(at, radius, width, brush) {
    this.#put(shapes.ring(...this.#at(at), radius * this.unit, width * this.unit), brush);
  }

  polygon(corners, brush) {
    this.#put(shapes.polygon(corners.map((corner) => this.#at(corner))), brush);
  }
}

const wall = { material: "wall", colour: "#c9bfae" };
const lamp = (colour, brightness) => ({ material: "lamp", colour, brightness });
const glass = (colour, density = 1.4) => ({ material: "glass", colour, density });
const fog = (density, colour = "#c8d4e0") => ({ material: "fog", colour, density });

/** Four rooms around a hall, doors ajar, a light of its own in each. */
function rooms(size) {
  const b = new Builder(size, "boards", [0, 0, 0]);
  const pieces = [
    [
      [2, 2],
      [254, 2],
    ],
    [
      [2, 254],
      [254, 254],
    ],
    [
      [2, 2],
      [2, 254],
    ],
    [
      [254, 2],
      [254, 100],
    ],
    [
      [254, 150],
      [254, 254],
    ],
    [
      [100, 2],
      [100, 56],
    ],
    [
      [100, 84],
      [100, 108],
    ],
    [
      [2, 108],
      [58, 108],
    ],
    [
      [82, 108],
      [130, 108],
    ],
    [
      [160, 108],
      [254, 108],
    ],
    [
      [150, 2],
      [150, 30],
    ],
    [
      [150, 62],
      [150, 108],
    ],
    [
      [2, 164],
      [40, 164],
    ],
    [
      [72, 164],
      [118, 164],
    ],
    [
      [118, 164],
      [118, 190],
    ],
    [
      [118, 218],
      [118, 254],
    ],
    [
      [118, 164],
      [176, 164],
    ],
    [
      [206, 164],
      [254, 164],
    ],
  ];
  for (const [from, to] of pieces) b.line(from, to, 5, wall);
  const doors = [
    [
      [58, 108],
      [72, 90],
    ],
    [
      [100, 84],
      [116, 74],
    ],
    [
      [206, 164],
      [196, 146],
    ],
    [
      [118, 190],
      [104, 202],
    ],
  ];
  for (const [from, to] of doors) b.line(from, to, 2.5, { material: "wall", colour: "#7a5230" });
  b.box([30, 190], [62, 200], wall);
  b.disc([196, 208], 9, wall);
  for (let i = 0; i < 5; i++) {
    const angle = (i * 2 * Math.PI) / 5;
    b.disc([196 + 17 * Math.cos(angle), 208 + 17 * Math.sin(angle)], 3, wall);
  }
  b.disc([44, 46], 5, lamp("#ffb765", 4));
  b.disc([124, 28], 3, lamp("#59d0ff", 4));
  b.disc([214, 44], 5, lamp("#ff5d8f", 3.4));
  b.disc([24, 230], 4, lamp("#ffd9a0", 5));
  b.disc([238, 238], 4, lamp("#8dff9a", 2.4));
  b.box([140, 244], [168, 247], lamp("#ff8c3b", 3));
  b.disc([24, 136], 2.5, lamp("#fff1d6", 6));
  return b.world;
}

/** A temple: columns around a fire, moonlight from the side. */
function pillars(size) {
  const b = new Builder(size, "tiles", [0.012, 0.02, 0.045]);
  const column = { material: "wall", colour: "#d8d2c4" };
  for (let i = 0; i < 14; i++) {
    const angle = (i * 2 * Math.PI) / 14 + 0.11;
    b.disc([128 + 74 * Math.cos(angle), 128 + 74 * Math.sin(angle)], 6, column);
  }
  for (let i = 0; i < 7; i++) {
    const angle = (i * 2 * Math.PI) / 7 + 0.4;
    b.disc([128 + 40 * Math.cos(angle), 128 + 40 * Math.sin(angle)], 3.5, column);
  }
  b.ring([128, 128], 13, 2, { material: "wall", colour: "#5b5148" });
  for (let i = 0; i < 6; i++) {
    const angle = (i * 2 * Math.PI) / 6;
    b.disc([128 + 13 * Math.cos(angle), 128 + 13 * Math.sin(angle)], 3.4, { material: "eraser", colour: "#000000" });
  }
  b.disc([128, 128], 7, lamp("#ff8a2b", 6));
  b.disc([26, 30], 11, lamp("#9db9ff", 1.5));
  b.disc([226, 214], 4, lamp("#35e0c2", 2.4));
  b.disc([214, 34], 3, lamp("#ff4f6d", 4));
  return b.world;
}

/** A chapel: lamps outside, panes of coloured glass, mist on the floor. */
function stained(size) {
  const b = new Builder(size, "tiles", [0.004, 0.006, 0.012]);
  b.polygon(
    [
      [52, 150],
      [90, 140],
      [128, 152],
      [170, 142],
      [206, 154],
      [206, 236],
      [52, 236],
    ],
    fog(0.22),
  );
  b.polygon(
    [
      [52, 186],
      [100, 178],
      [150, 190],
      [206, 182],
      [206, 236],
      [52, 236],
    ],
    fog(0.35),
  );
  const stone = { material: "wall", colour: "#a79f93" };
  const pieces = [
    [
      [48, 20],
      [208, 20],
    ],
    [
      [48, 240],
      [112, 240],
    ],
    [
      [144, 240],
      [208, 240],
    ],
    [
      [48, 20],
      [48, 240],
    ],
    [
      [208, 20],
      [208, 240],
    ],
  ];
  for (const [from, to] of pieces) b.line(from, to, 7, stone);
  const colours = ["#ff3b30", "#ffd60a", "#2f6bff", "#30d158", "#ff375f", "#64d2ff"];
  [46, 100, 154].forEach((top, row) =>
    [48, 208].forEach((x, side) => {
      for (let pane = 0; pane < 3; pane++)
        b.box([x - 4, top + pane * 12], [x + 4, top + pane * 12 + 11], glass(colours[(row * 2 + side * 3 + pane) % 6]));
    }),
  );
  for (const y of [72, 126, 180]) for (const x of [92, 164]) b.disc([x, y], 4.5, stone);
  b.box([112, 38], [144, 46], { material: "wall", colour: "#d9c9a0" });
  for (const x of [116, 128, 140]) b.disc([x, 35], 1.6, lamp("#ffc46b", 5));
  for (const y of [62, 116, 170]) {
    b.disc([16, y], 7, lamp("#fff3dd", 4.5));
    b.disc([240, y], 7, lamp("#e8f0ff", 4.5));
  }
  return b.world;
}

/** The name in neon over a wet street. */
function neon(size) {
  const b = new Builder(size, "bricks", [0.006, 0.006, 0.014]);
  const unit = 4.2,
    text = "DAPPLE",
    left = (256 - widthOfText(text) * unit) / 2;
  const colours = ["#ff2d6f", "#ff2d6f", "#ff8a1f", "#ff8a1f", "#2fd6ff", "#2fd6ff"];
  linesOfText(text, left, 74, unit).forEach((lines, at) => {
    for (const [from, to] of lines) b.line(from, to, 2.6, lamp(colours[at], 2.6));
  });
  b.line([18, 56], [238, 56], 3, wall);
  for (const x of [18, 238]) b.line([x, 30], [x, 56], 3, wall);
  b.line([left, 132], [256 - left, 132], 1.6, lamp("#b46bff", 1.8));
  for (let i = 0; i < 13; i++) b.disc([28 + i * 16.7, 168 + 9 * Math.sin(i * 1.1)], 2 + (i % 3), wall);
  b.box([0, 214], [256, 256], fog(0.3, "#9fb4ff"));
  for (const x of [52, 128, 204]) b.line([x, 196], [x, 226], 3.4, wall);
  b.disc([90, 240], 3, lamp("#43ffb0", 2.4));
  b.disc([170, 238], 3, lamp("#ff4fd8", 2.4));
  return b.world;
}

/** Nothing but a floor, and one lamp to begin with. */
function empty(size) {
  const b = new Builder(size, "boards", [0.01, 0.012, 0.018]);
  b.disc([128, 128], 7, lamp("#ffc27a", 4));
  return b.world;
}

/** By name: (size) => World. */
export const PRESETS = { rooms, pillars, stained, neon, empty };
