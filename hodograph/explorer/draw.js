// The picture: one scale for both axes, ground, paths, marks.

const EDGE = { left: 3.3, right: 2.4, top: 2.9, bottom: 2.6 }; // in sizes of the text, for labels

const $ = (id) => document.getElementById(id);
const px = (value) => value.toFixed(2);

// Steps of 1, 2 or 5 times a power of ten.
function niceStep(rough) {
  const power = 10 ** Math.floor(Math.log10(rough));
  return power * [1, 2, 5, 10].find((k) => k * power >= rough * 0.999);
}

const shown = (value, digits) => {
  if (!isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size >= 1e6 || (size && size < 1e-3)) return value.toExponential(2).replace("e+", "e");
  const decimals = max(0, digits - 1 - (size ? max(Math.floor(Math.log10(size)), 0) : 0));
  return value.toFixed(min(decimals, 3)).replace("-", "\u2212");
};

// The tick's own digits and no more.
function tick(value, step) {
  if (value === 0) return "0";
  if (step >= 1e5 || step < 1e-4) return value.toExponential(1).replace(/\.0(?=e)|\+/g, "");
  return value.toFixed(max(0, -Math.floor(Math.log10(step) + 1e-9))).replace("-", "\u2212");
}

// Where metres lie in a box of so many pixels that all points fit in.  The scale goes in steps, so that
// a path grows while a slider moves.
function makeView(points, width, height) {
  let [x0, x1, y0, y1] = [0, 0, 0, 0];
  for (const { x, y } of points) {
    x0 = min(x0, x); x1 = max(x1, x); y0 = min(y0, y); y1 = max(y1, y);
  }
  const em = parseFloat(getComputedStyle(document.documentElement).fontSize), edge = {};
  for (const side in EDGE) edge[side] = EDGE[side] * em;
  const across = width - edge.left - edge.right, up = height - edge.top - edge.bottom;
  const fit = min(across / max(x1 - x0, 1e-9), up / max(y1 - y0, 1e-9));
  const scale = 10 ** (Math.floor(20 * Math.log10(min(fit, 1e9)) + 1e-9) / 20);
  const left = edge.left + (x0 < 0 ? max((across - (x1 - x0) * scale) / 2, 0) : 0) - x0 * scale;
  const base = height - edge.bottom + y0 * scale;
  const X = (x) => left + x * scale, Y = (y) => base - y * scale;
  return { X, Y, scale, width, height, edge, em };
}

// A path as cubics: each joins two points with their directions.
function curve(view, points) {
  const { X, Y } = view;
  let d = `M${px(X(points[0].x))} ${px(Y(points[0].y))}`;
  for (let i = 1; i < points.length; i++) {
    const a = points[i - 1], b = points[i], third = (b.t - a.t) / 3;
    d += `C${px(X(a.x + a.vx * third))} ${px(Y(a.y + a.vy * third))} `
      + `${px(X(b.x - b.vx * third))} ${px(Y(b.y - b.vy * third))} ${px(X(b.x))} ${px(Y(b.y))}`;
  }
  return d;
}

const text = (x, y, words, look = "", anchor = "middle") =>
  `<text x="${px(x)}" y="${px(y)}" class="${look}" text-anchor="${anchor}">${words}</text>`;

// Grid lines and their numbers, ground, wind.
function drawGround(view, { height, slope, wind }) {
  const { X, Y, scale, width, edge, em } = view, step = niceStep(3.8 * em / scale), parts = [];
  const low = view.height - edge.bottom, rise = Math.tan(slope);
  for (let k = Math.ceil((edge.left - X(0)) / scale / step); X(k * step) <= width - 8; k++) {
    const at = X(k * step);
    parts.push(`<line x1="${px(at)}" x2="${px(at)}" y1="${1.8 * em}" y2="${px(low)}"/>`);
    if (at < width - 2 * em) parts.push(text(at, low + em, tick(k * step, step)));
  }
  for (let k = Math.ceil((Y(0) - low) / scale / step); Y(k * step) >= 1.8 * em; k++) {
    const at = Y(k * step);
    parts.push(`<line x1="${edge.left}" x2="${width - 8}" y1="${px(at)}" y2="${px(at)}"/>`);
    parts.push(text(edge.left - 6, at + 0.27 * em, tick(k * step, step), "", "end"));
  }
  parts.push(text(width - 8, low + 2.1 * em, "<tspan font-style='italic'>x</tspan> (m)", "", "end"));
  parts.push(text(4, em, "<tspan font-style='italic'>y</tspan> (m)", "", "start"));
  if (wind) {
    const y = 0.7 * em, way = Math.sign(wind), middle = width / 2;
    const head = `m${-7 * way} -5l${7 * way} 5l${-7 * way} 5`;
    parts.push(`<path class="arrow" d="M${middle - 30 * way} ${y}H${middle + 30 * way}${head}"/>`);
    parts.push(text(middle, y + 1.1 * em, `${word("windMark")} ${short(Math.abs(wind))} m/s`));
  }
  if (height > 0) {
    const [x, top] = [X(0), Y(height)];
    parts.push(`<path class="tower" d="M${px(x)} ${px(top)}V${px(Y(0))}M${px(x - 6)} ${px(top)}h12"/>`);
  }
  const level = (at) => px(Y((at - X(0)) / scale * rise)), [left, right] = [px(edge.left), width];
  const line = `M${left} ${level(edge.left)}L${right} ${level(width)}`;
  $("ground").setAttribute("d", `${line}V${view.height}H${left}Z`);
  $("grid").innerHTML = `${parts.join("")}<path class="surface" d="${line}"/>`;
}

const dot = ({ X, Y }, { x, y }) => `<circle cx="${px(X(x))}" cy="${px(Y(y))}" r="4.5"/>`;

// The highest point and the landing, with their numbers beside them, inside the picture.
function apexMark(view, top) {
  const at = view.X(top.x), room = 6 * view.em;
  const side = at < room ? "start" : at > view.width - room ? "end" : "middle";
  const words = `${word("apexMark")} ${shown(top.y, 4)} m`;
  return dot(view, top) + text(at, view.Y(top.y) - 0.7 * view.em, words, "", side);
}

function landingMark(view, landing) {
  const at = view.X(landing.x), room = 6 * view.em, words = `${shown(landing.x, 4)} m`;
  const back = landing.vx < 0 ? at > room : at > view.width - room, y = view.Y(landing.y) - 0.5 * view.em;
  return dot(view, landing) + text(at + (back ? -8 : 8), y, words, "", back ? "end" : "start");
}

// The arrow of the launch.
function launchArrow({ X, Y }, { height, alpha0 }) {
  const [x, y] = [X(0), Y(height)], [c, s] = [Math.cos(alpha0), Math.sin(alpha0)];
  const tip = [x + 44 * c, y - 44 * s], at = ([a, b]) => `${px(a)} ${px(b)}`;
  const wing = (turn) => {
    const a = alpha0 + turn;
    return `M${at(tip)}L${at([tip[0] - 9 * Math.cos(a), tip[1] + 9 * Math.sin(a)])}`;
  };
  return `<path class="arrow launch" d="M${at([x, y])}L${at(tip)}${wing(0.45)}${wing(-0.45)}"/>`;
}

// The nodes of a stepping method, joined by lines, with dots where they are few.
function steppedPath(view, nodes, look) {
  const { X, Y } = view, few = nodes.length <= 150;
  const every = max(1, Math.floor(nodes.length / 600)), points = nodes.filter((_, k) => k % every === 0);
  const places = points.map(([, , x, y]) => `${px(X(x))} ${px(Y(y))}`);
  const dots = few ? places.map((place) => `M${place}h0`).join("") : "";
  return `<path class="steps ${look}" d="M${places.join("L")}"/><path class="dots ${look}" d="${dots}"/>`;
}
