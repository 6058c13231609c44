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
  // Wider and higher than the blocks of 16 rows that one word, and one window, of the masks has bits for.
  "walls at the border": {
    size: [560, 300],
    sky: [0.02, 0.03, 0.05],
    shapes: [
      wall(20.2, 80.1, [38, 39]),
      wall(86.3, 120.2, [14, 17]),
      wall(540.1, 290.3, [40, 30], 0.3),
      lamp(290.3, 100.2, 9, [1, 0.8, 0.5]),
      lamp(400.2, 210.4, 6, [0.3, 0.6, 1]),
    ],
  },
  "a tower": {
    size: [24, 1100],
    sky: [0.1, 0.1, 0.1],
    shapes: [lamp(12.31, 30.17, 5.3, [1, 2, 3]), lamp(5.13, 1050.21, 4.4, [3, 2, 1]), wall(18.23, 530.17, [4.4, 40.3])],
  },
  "a pixel": { size: [1, 1], sky: [0.5, 0.25, 0.125] },
  "a column": { size: [1, 40], sky: [0.1, 0.1, 0.1], shapes: [lamp(0.5, 20.5, 0.6, [1, 2, 3])] },
  "a row with a lamp": { size: [67, 3], shapes: [lamp(20.5, 1.5, 0.6, [1, 2, 3]), wall(40.5, 1.5, [0.6, 0.6])] },
};
