// The panels below the picture: kept paths, and the methods that step.

const digits = (value, count) => (isFinite(value) ? value.toPrecision(count) : "–");

const short = (value) => String(Number(value.toPrecision(4))).replace("-", "\u2212");

// "40 m/s, 40°, ...": what a launch is, as far as it is not the usual.
function described(one) {
  const parts = [`${short(one.v0)} m/s`, `${short(one.angle)}°`];
  if (one.v_lim < Infinity) parts.push(`${word("v_lim").toLowerCase()} ${short(one.v_lim)} m/s`);
  else parts.push(word("withoutDrag"));
  if (one.n === 1 && one.v_lim < Infinity) parts.push("n = 1");
  for (const name of ["height", "wind", "slope", "g"]) {
    const { usual, unit } = QUANTITIES[name];
    if (one[name] !== usual) parts.push(`${word(name).toLowerCase()} ${short(one[name])} ${unit}`);
  }
  return parts.join(", ");
}

// The list of kept paths; drawn again only when it has changed.
function listKept() {
  const rows = state.kept.map((one, k) => {
    const landing = meet(sceneOf(one)), range = landing ? `${shown(landing.x, 5)} m` : "–";
    const words = described(one);
    return `<li><span class="swatch kept-${k + 1}" aria-hidden="true">${k + 1}</span>`
      + `<span class="what">${words} <b>${range}</b></span>`
      + `<button type="button" data-show="${k}" aria-label="${word("show")}: ${words}">${word("show")}</button>`
      + `<button type="button" data-remove="${k}" aria-label="${word("remove")}: ${words}">✕</button></li>`;
  });
  $("kept").innerHTML = rows.join("");
  $("keep").disabled = state.kept.length >= MOST_KEPT;
  $("keep").title = $("keep").disabled ? word("full") : "";
}

// Each method's range and error, in a table; gives back what to draw.
function compareMethods(scene, landing) {
  const runs = Object.keys(METHODS).map((name) => [name, stepped(scene, name, state.dt)]);
  const exact = landing ? landing.x : NaN, rows = runs.map(([name, run]) => {
    const head = `<tr><th scope="row"><span class="line ${name}" aria-hidden="true"></span>${word(name)}</th>`;
    if (run.status !== LANDED) {
      return `${head}<td colspan="5">${word(run.status === UNSTABLE ? "unstable" : "many")}</td></tr>`;
    }
    const error = run.x - exact, part = 100 * error / exact;
    const cells = [digits(run.x, 7), signed(error), signed(part), digits(run.naive, 7), run.steps];
    return `${head}${cells.map((cell) => `<td>${cell}</td>`).join("")}</tr>`;
  });
  $("errors").innerHTML = rows.join("");
  return runs;
}

function signed(value) {
  if (!isFinite(value)) return "–";
  const size = Math.abs(value), plainly = size >= 1e-3 && size < 1e5;
  const words = plainly ? size.toPrecision(3) : size.toExponential(1);
  return value === 0 ? "0" : `${value < 0 ? "\u2212" : "+"}${words}`;
}

// Error against dt, both by powers of ten: a method of order p falls by p decades in one.
function drawConvergence(scene, landing) {
  const svg = $("convergence"), width = svg.clientWidth, height = svg.clientHeight;
  if (!(width > 80) || !landing || !(Math.abs(landing.x) > 0)) return void (svg.innerHTML = "");
  const lines = {}, steps = Array.from({ length: 11 }, (_, k) => landing.t / 2 ** (k + 1));
  let [low, high] = [-1, 1];
  for (const name of Object.keys(METHODS)) {
    lines[name] = [];
    for (const dt of steps) {
      const run = stepped(scene, name, dt, false);
      const error = Math.abs(100 * (run.x / landing.x - 1));
      if (run.status !== LANDED || !(error > 1e-12)) continue;
      lines[name].push([Math.log10(dt), Math.log10(error)]);
      low = min(low, Math.floor(Math.log10(error)));
      high = max(high, Math.ceil(Math.log10(error)));
    }
  }
  high = min(high, 4);
  const [from, to] = [Math.log10(steps.at(-1)), Math.log10(steps[0])];
  const [left, right, top, bottom] = [52, 10, 12, 40], [end, floor] = [width - right, height - bottom];
  const X = (s) => left + (s - from) / (to - from) * (end - left);
  const Y = (e) => top + (high - e) / (high - low) * (floor - top);
  const line = (x1, x2, y1, y2, look = "") =>
    `<line class="${look}" x1="${px(x1)}" x2="${px(x2)}" y1="${px(y1)}" y2="${px(y2)}"/>`;
  const power = (k) =>
    `10<tspan dy="-5" font-size="75%">${String(k).replace("-", "\u2212")}</tspan>`;
  const parts = [];
  for (let k = low; k <= high; k += Math.ceil((high - low) / 7)) {
    parts.push(line(left, end, Y(k), Y(k)), text(left - 6, Y(k) + 4, power(k), "", "end"));
  }
  for (let k = Math.ceil(from); k <= to; k++) {
    parts.push(line(X(k), X(k), top, floor), text(X(k), floor + 17, power(k)));
  }
  parts.push(text(end, height - 5, word("stepAxis"), "", "end"));
  parts.push(text(left + 6, top + 12, word("errorAxis"), "", "start"));
  const now = Math.log10(state.dt);
  if (now >= from && now <= to) parts.push(line(X(now), X(now), top, floor, "now"));
  for (const [name, points] of Object.entries(lines)) {
    const inside = points.filter(([, e]) => e <= high).map(([s, e]) => `${px(X(s))} ${px(Y(e))}`);
    if (!inside.length) continue;
    const dots = inside.map((place) => `M${place}h0`).join("");
    parts.push(`<path class="steps ${name}" d="M${inside.join("L")}"/>`);
    parts.push(`<path class="dots ${name}" d="${dots}"/>`);
  }
  svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
  svg.innerHTML = parts.join("");
}
