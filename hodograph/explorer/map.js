// d_norm over v_norm and the launch angle (figure 3 of the paper), and the present launch on it.

const MAP_ENDS = [1.5, 5, 15, 50, 150, 500, 1500, 1e4, 1e5, 1e7]; // of the axis of v_norm
const MAP_COLUMNS = 76, MAP_ROWS = 46;
const MAP_EDGE = { left: 2.4, right: 1.2, top: 0.5, bottom: 2.3 }; // in sizes of the text
const BAND = 0.05, LINE_EVERY = 0.1, NOWHERE = 99;
// From little to all of the range: dark blue, green, yellow.
const COLOURS = [
  [68, 1, 84], [71, 45, 123], [59, 82, 139], [44, 114, 142], [33, 145, 140],
  [40, 174, 128], [94, 201, 98], [173, 220, 48], [253, 231, 37],
];
const tables = new Map(); // by exponent and end of the axis
let mapShown = "", mapWork = 0;

const mapEnd = (v) => MAP_ENDS.find((end) => v <= end) ?? MAP_ENDS.at(-1);

// Fill a table row by row, a few milliseconds at a time, and draw it.  Rows stand close where the angle
// is small, for there d_norm falls at once.
function makeTable(n, end, done) {
  const table = [], mine = ++mapWork;
  const more = () => {
    if (mine !== mapWork) return; // another one is wanted by now
    const until = performance.now() + 4;
    while (table.length < MAP_ROWS && performance.now() < until) {
      const alpha0 = RIGHT_ANGLE * (table.length / (MAP_ROWS - 1)) ** 2, row = new Float64Array(MAP_COLUMNS);
      for (let j = 0; j < MAP_COLUMNS; j++) row[j] = dNorm(end * j / (MAP_COLUMNS - 1), alpha0, n);
      table.push(row);
    }
    if (table.length < MAP_ROWS) return void setTimeout(more);
    tables.set(`${n} ${end}`, table);
    done();
  };
  more();
}

function colourOf(d, least) {
  const at = min(max((d - least) / (1 - least), 0), 1) * (COLOURS.length - 1);
  const k = min(Math.floor(at), COLOURS.length - 2);
  return COLOURS[k].map((c, i) => c + (at - k) * (COLOURS[k + 1][i] - c));
}

// The table between its points, in bands, with a line wherever d passes a tenth.
function paintMap(table, canvas, width, height) {
  const dense = min(devicePixelRatio || 1, 2);
  const [w, h] = [Math.round(width * dense), Math.round(height * dense)];
  [canvas.width, canvas.height] = [w, h];
  const context = canvas.getContext("2d"), image = context.createImageData(w, h);
  const least = min(...table.map((row) => min(...row)), 0.35);
  const palette = Array.from({ length: 21 }, (_, k) => colourOf((k + 0.5) * BAND, least));
  const line = new Int8Array(w).fill(NOWHERE), dark = least + 0.57 * (1 - least); // lines are white below
  for (let i = 0; i < h; i++) {
    const up = sqrt(1 - (i + 0.5) / h) * (MAP_ROWS - 1), r = min(Math.floor(up), MAP_ROWS - 2), q = up - r;
    let before = NOWHERE;
    for (let j = 0; j < w; j++) {
      const right = (j + 0.5) / w * (MAP_COLUMNS - 1), c = min(Math.floor(right), MAP_COLUMNS - 2);
      const p = right - c;
      const d = (1 - q) * ((1 - p) * table[r][c] + p * table[r][c + 1])
        + q * ((1 - p) * table[r + 1][c] + p * table[r + 1][c + 1]);
      const level = Math.floor(d / LINE_EVERY);
      const edge = [before, line[j]].some((near) => near !== NOWHERE && near !== level);
      const ink = d < dark ? [255, 255, 255] : [0, 0, 0];
      const colour = edge ? ink : palette[min(Math.floor(d / BAND), 20)];
      image.data.set([...colour, 255], 4 * (i * w + j));
      before = line[j] = level;
    }
  }
  context.putImageData(image, 0, 0);
}

// Where the map is in its box, and what lies at a point of it.
function mapBox() {
  const em = parseFloat(getComputedStyle(document.documentElement).fontSize);
  const [left, right, top, bottom] = ["left", "right", "top", "bottom"].map((side) => MAP_EDGE[side] * em);
  const box = $("map").parentElement.clientWidth;
  const height = Math.round(box * (box < 32 * em ? 0.8 : 0.55));
  return { em, box, height, left, top, width: box - left - right, tall: height - top - bottom };
}

function drawMap(v, alpha0, n) {
  const end = mapEnd(isFinite(v) ? v : 0), table = tables.get(`${n} ${end}`);
  const { em, box, height, left, top, width, tall } = mapBox();
  if (!(width > 50)) return;
  if (!table) return makeTable(n, end, () => schedule());
  const key = `${n} ${end} ${box} ${devicePixelRatio}`, over = $("map-over");
  const X = (at) => left + at / end * width, Y = (degrees) => top + (1 - degrees / 90) * tall;
  if (key !== mapShown) {
    mapShown = key;
    const part = (length, whole) => `${100 * length / whole}%`; // so that it fits on paper too
    $("map").parentElement.style.aspectRatio = box / height;
    Object.assign($("map").style, {
      width: part(width, box), height: part(tall, height), left: part(left, box), top: part(top, height),
    });
    paintMap(table, $("map"), width, tall);
  }
  const parts = [], step = niceStep(end / max(width / (3.5 * em), 2));
  for (let k = 0; k * step <= end * 1.0001; k++) {
    parts.push(text(X(k * step), top + tall + em, tick(k * step, step)));
  }
  for (let a = 0; a <= 90; a += 15) parts.push(text(left - 5, Y(a) + 0.27 * em, a, "", "end"));
  const name = "<tspan font-style='italic'>v</tspan><tspan dy='3' font-size='80%'>norm</tspan>";
  parts.push(text(left + width, top + tall + 2.1 * em, name, "", "end"));
  parts.push(text(left, top + tall + 2.1 * em, `↑ ${word("launchAngle")}`, "", "start"));
  const row = table[Math.round(sqrt(60 / 90) * (MAP_ROWS - 1))]; // labels in a row, at 60 degrees
  const dark = 0.57 + 0.43 * min(...row, 0.35);
  for (let d = 1, free = Infinity; d <= 9; d++) { // from the right
    const j = row.findIndex((value) => value < d / 10);
    if (j < 1) continue;
    const at = X((j - 1 + (row[j - 1] - d / 10) / (row[j - 1] - row[j])) / (MAP_COLUMNS - 1) * end);
    if (at > left + em && at < min(left + width - em, free)) {
      parts.push(text(at, Y(60) + 4, (d / 10).toFixed(1), d / 10 < dark ? "level light" : "level"));
      free = at - 2.2 * em;
    }
  }
  if (alpha0 >= 0 && isFinite(v)) {
    const [x, y] = [X(min(v, end)), Y(alpha0 * 180 / Math.PI)];
    const ring = (look) => `<circle class="${look}" cx="${px(x)}" cy="${px(y)}" r="7"/>`;
    parts.push(ring("ring-back"), ring("ring"));
  }
  over.setAttribute("viewBox", `0 0 ${box} ${height}`);
  over.innerHTML = parts.join("");
}
