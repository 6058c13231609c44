/** Scenes that the back end is compared on, in the words of docs/scene-format.md. */

const lamp = (x, y, radius, emission) => ({ disc: { center: [x, y], radius }, emission });
const wall = (x, y, half, angle = 0) => ({ box: { center: [x, y], half, angle } });

const LAMPS_AND_WALLS = [
  lamp(40.3, 35.6, 7.2, [1, 0.7, 0.3]),
  lamp(150.1, 110.4, 5.5, [0.2, 0.5, 1]),
  lamp(30.2, 120.7, 3.1, [0.4, 1, 0.4]),
  wall(90.2, 70.3, [20, 6], 0.4),
  wall(150.4, 40.1, [4, 25], -0.2),
  wall(60.3, 110.2, [15.3, 1], 1.1),
  lamp(199, 2, 3, [2, 2, 2]),
];

/**
 * Twelve lamps and six walls in 512 x 512 pixels, as the paper's scenes have them, or that many times as large; a lower
 * world cuts some off.
 */
export function paperLike(width, height, times = 1) {
  let seed = 1;
  const random = (low, high) => {
    seed = (seed * 48271) % 2147483647;
    return low + ((high - low) * seed) / 2147483647;
  };
  const length = (low, high) => times * random(low, high);
  const place = () => [length(30, 482), length(30, 482)];
  const someWall = () => wall(...place(), [length(10, 40), length(10, 40)]);
  const someLamp = () => lamp(...place(), length(5, 12), [random(0.3, 1), random(0.3, 1), random(0.3, 1)]);
  const shapes = [...Array.from({ length: 6 }, someWall), ...Array.from({ length: 12 }, someLamp)];
  return { size: [width, height], sky: [0.02, 0.03, 0.05], shapes };
}

export const SCENES = {
  "lamps and walls": { size: [200, 150], sky: [0.02, 0.03, 0.05], shapes: LAMPS_AND_WALLS },
  "fog that glows": {
    size: [130, 90],
    sky: [0.1, 0.1, 0.2],
    shapes: [
      { disc: { center: [65.2, 45.3], radius: 40.1 }, extinction: 0.03, emission: 0.2 },
      { box: { center: [100.1, 30.2], half: [12, 9] }, extinction: 2.5 },
      lamp(30.3, 40.2, 5, [3, 2, 1]),
      wall(70.2, 60.1, [3, 12], 0.5),
    ],
  },
  "tinted glass": {
    size: [90, 130],
    shapes: [
      { box: { center: [45.2, 60.1], half: [30, 3], angle: 0.2 }, extinction: [0.5, 0.02, 1.5] },
      { disc: { center: [20.3, 95.2], radius: 12.4 }, extinction: [0, 0.2, 0.1], emission: [0, 1, 0] },
      lamp(45.1, 20.2, 6.3, [4, 4, 4]),
      wall(70.2, 100.3, [8, 8], 0.7),
    ],
  },
  "like the paper's": paperLike(512, 256), // as long as a word of a row's mask has bits for blocks
  // Higher than a window of the masks.
  "a tower": {
    size: [24, 1100],
    sky: [0.1, 0.1, 0.1],
    shapes: [lamp(12.31, 30.17, 5.3, [1, 2, 3]), lamp(5.13, 1050.21, 4.4, [3, 2, 1]), wall(18.23, 530.17, [4.4, 40.3])],
  },
  "a pixel": { size: [1, 1], sky: [0.5, 0.25, 0.125] },
  "a column": { size: [1, 40], sky: [0.1, 0.1, 0.1], shapes: [lamp(0.5, 20.5, 0.6, [1, 2, 3])] },
  "a row with a lamp": { size: [67, 3], shapes: [lamp(20.5, 1.5, 0.6, [1, 2, 3]), wall(40.5, 1.5, [0.6, 0.6])] },
};
