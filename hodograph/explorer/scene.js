// Scenes in SI units: wind, sloping ground, the path, the angle of greatest range.
//
// A scene is { v0, alpha0, vLim, n, g, height, slope, wind }: angles in radians, vLim Infinity for
// vacuum, height that of the launch over the ground at x = 0.  A uniform wind is exact: in the frame
// of the moving air the equations are those of still air, so the launch has the velocity relative to
// the air, and the ground moves past at the speed of the wind.

const LEAST_SPEED = 1e-12; // slower than this part of the speed that the fall brings: at rest
const LEAST_COSINE = 6e-17; // that of 90 degrees in doubles

// The launch as the air sees it, and the units of its flight.  Without drag there is no air.
function airborne({ v0, alpha0, vLim, n, g, height, wind }) {
  const w = vLim < Infinity ? wind : 0;
  let vx = v0 * Math.cos(alpha0) - w, vy = v0 * Math.sin(alpha0);
  let speed = w ? Math.hypot(vx, vy) : v0, thrown = 1; // the part of x that is there
  let sin0 = Math.sin(alpha0), cos0 = Math.cos(alpha0);
  if (w && speed) [sin0, cos0] = [vy / speed, max(Math.abs(vx) / speed, LEAST_COSINE)];
  const least = LEAST_SPEED * min(max(sqrt(g * Math.abs(height)), Math.abs(w)), vLim);
  if (!(speed > least)) [thrown, speed, sin0, cos0] = [0, least || min(vLim, 1), 0, 1];
  const time = speed / g, length = speed * time, v = speed / vLim;
  return {
    v, n: v ? n : 1, sin0, cos0, heading: vx < 0 ? -thrown : thrown, wind: w, speed, time, length,
    height: height / length,
  };
}

const still = (own) => own.heading === 0 && own.height === 0 && own.wind === 0;

// The landing over ground: x, y, t, v_x, v_y and the angle above the horizontal, whichever way it
// goes; null where the ground is never met.
function meet(scene) {
  const own = airborne(scene), { v, n, sin0, cos0, heading, wind, speed, time, length } = own;
  if (still(own)) return { x: 0, y: 0, t: 0, vx: 0, vy: 0, alpha: -Math.abs(scene.alpha0) };
  if (scene.slope) return meetSlope(scene, own);
  const landed = (n === 1 ? flyLinear : fly)(v, sin0, cos0, own.height);
  if (!landed) return null;
  const { tangent } = landed, down = 1 / Math.hypot(1, tangent), t = landed.t * time;
  const vx = heading * landed.speed * speed * down + wind;
  const vy = -landed.speed * speed * (tangent < Infinity ? tangent * down : 1);
  const alpha = wind ? Math.atan2(vy, Math.abs(vx)) : -atan(tangent);
  return { x: heading * landed.x * length + wind * t, y: 0, t, vx, vy, alpha };
}

// The same on a slope, met first where f = y + height - x tan(slope) is no longer positive.
function meetSlope(scene, own) {
  const { v, n, sin0, cos0, heading, time, length, speed } = own, T = Math.tan(scene.slope);
  const W = own.wind / speed, way = (n === 1 ? courseLinear : course)(v, sin0, cos0);
  const gap = ([x, y, t]) => own.height + y - (heading * x + W * t) * T;
  const gaining = ([, , , vx, vy]) => vy - (heading * vx + W) * T;
  const found = (at) => {
    const [x, , t, vx, vy] = at, X = (heading * x + W * t) * length;
    const across = heading * vx * speed + own.wind, up = vy * speed;
    const alpha = Math.atan2(up, Math.abs(across));
    return { x: X, y: X * T, t: t * time, vx: across, vy: up, alpha };
  };
  if (!v) { // a parabola
    const a = sin0 - heading * cos0 * T, root = sqrt(a * a + 2 * own.height);
    if (!(root >= 0) || (own.height < 0 && a < 0)) return null;
    return found(way.at(max(a < 0 ? 2 * own.height / (root - a) : a + root, 0)));
  }
  const start = way.at(0), lift = v ** n * (heading * cos0 * T - sin0) - 1; // of a body at rest
  if (own.height === 0 && (gaining(start) || lift) <= 0) { // at once
    return { ...found(start), alpha: scene.alpha0 };
  }
  let before = 0, f = own.height, rate = gaining(start);
  for (const place of way.knots(way.end, 32).slice(1)) {
    const at = way.at(place), pieces = [place];
    // The gap may turn in between, and the ground be met on one side of the turn.
    if (rate > 0 !== gaining(at) > 0) pieces.unshift(root((s) => gaining(way.at(s)), before, place));
    for (const until of pieces) {
      const there = way.at(until), after = gap(there);
      if (f > 0 && after <= 0) {
        const slip = (s) => gap(way.at(s)), slope = (s) => gaining(way.at(s)) * way.rate(s);
        return found(way.at(root(slip, before, until, slope)));
      }
      [before, f] = [until, after];
    }
    rate = gaining(at);
  }
  // At terminal speed, straight down through the air.
  const last = way.at(before), sinking = 1 / v + W * T;
  if (!(f > 0)) return own.height === 0 ? found(start) : null; // grazed, or never above ground
  if (!(sinking > 0)) return null;
  const fallen = f / sinking;
  return found([last[0], last[1] - fallen / v, last[2] + fallen, 0, -1 / v]);
}

// A root of f between two places where its signs differ: Newton, or halving where that leaves them.
function root(f, low, high, slope = null) {
  const falling = f(high) <= 0;
  let s = 0.5 * (low + high), rounds = 100;
  while (rounds--) {
    const value = f(s);
    if (value > 0 === falling) low = s; else high = s;
    let step = slope && rounds > 40 ? -value / slope(s) : NaN;
    if (value === 0 || Math.abs(step) <= 2 * EPSILON * s) return s;
    if (!(s + step > low && s + step < high)) step = 0.5 * (low + high) - s;
    if (s + step === s) return s;
    s += step;
  }
  return s;
}

// The highest point: x, y over the ground's level at x = 0, t.
function apex(scene) {
  const own = airborne(scene), { v, n, sin0, cos0, heading, wind, time, length } = own;
  const [x, y, t] = (n === 1 ? climbLinear : climb)(v, sin0, cos0).up;
  return {
    x: heading * x * length + wind * t * time, y: scene.height + y * length, t: t * time,
  };
}

// Points { t, x, y, vx, vy } of the path as far as the landing; where there is none, as far as the
// launch's own level, or for a while.
function path(scene, landing) {
  const own = airborne(scene), { v, n, sin0, cos0, heading, wind, speed, time, length } = own;
  const start = {
    t: 0, x: 0, y: scene.height,
    vx: scene.v0 * Math.cos(scene.alpha0), vy: scene.v0 * Math.sin(scene.alpha0),
  };
  const landed = landing ?? meet({ ...scene, height: 0, slope: 0 });
  if (still(own) || !(landed.t > 0)) return [start];
  const way = (n === 1 ? courseLinear : course)(v, sin0, cos0);
  const steep = -landed.vy / Math.abs(landed.vx - wind);
  const last = n === 1 ? landed.t / time : asinh(sin0 / cos0) + asinh(steep);
  const points = [start];
  for (const place of way.knots(min(last, way.end), 24).slice(1, -1)) {
    const [x, y, t, vx, vy] = way.at(place);
    points.push({
      t: t * time, x: heading * x * length + wind * t * time, y: scene.height + y * length,
      vx: heading * vx * speed + wind, vy: vy * speed,
    });
  }
  const end = { ...landed, y: landing ? landed.y : scene.height };
  return [...points.filter((point) => point.t < end.t), end];
}

// Where it is at time t: the cubic through the neighbouring points and their velocities.
function along(points, t) {
  const i = points.findIndex((point) => point.t >= t);
  if (i <= 0) return i ? points.at(-1) : points[0];
  const [a, b] = [points[i - 1], points[i]], step = b.t - a.t, part = (t - a.t) / step;
  const p = part * part * (3 - 2 * part), q = part * (1 - part) * step;
  const mix = (name, rate) =>
    a[name] + p * (b[name] - a[name]) + q * ((1 - part) * a[rate] - part * b[rate]);
  return { t, x: mix("x", "vx"), y: mix("y", "vy") };
}

// Range over the range without drag, on level ground in still air (eq. 21).
function dNorm(v, alpha0, n) {
  if (!(alpha0 >= 0)) return NaN;
  if (v ** n * alpha0 < 1e-18) return 1;
  const sin0 = Math.sin(alpha0), cos0 = Math.cos(alpha0);
  return min((n === 1 ? flyLinear : fly)(v, sin0, cos0, 0).x / (2 * sin0 * cos0), 1);
}

const GOLDEN = (sqrt(5) - 1) / 2;

// The angle of greatest range, where dR/d(alpha0) = 0; null where no angle reaches the ground, or
// all are alike.
function bestAngle(scene) {
  const range = (alpha0) => meet({ ...scene, alpha0 })?.x ?? -Infinity;
  const degree = Math.PI / 180, ranges = [];
  for (let k = -90; k <= 90; k++) ranges.push(range(k * degree));
  const most = max(...ranges), k = ranges.indexOf(most) - 90;
  if (!(scene.v0 > 0 && most > -Infinity)) return null;
  let low = max(k - 1, -90) * degree, high = min(k + 1, 90) * degree;
  let a = high - GOLDEN * (high - low), b = low + GOLDEN * (high - low);
  let [atA, atB] = [range(a), range(b)];
  while (high - low > 1e-6) {
    if (atA >= atB) {
      [high, b, atB] = [b, a, atA];
      a = high - GOLDEN * (high - low);
      atA = range(a);
    } else {
      [low, a, atA] = [a, b, atB];
      b = low + GOLDEN * (high - low);
      atB = range(b);
    }
  }
  // Differences of sixth order; on the scale of the angle itself, which is small for fast launches.
  const middle = 0.5 * (low + high), step = max(0.01 * Math.abs(middle), 1e-5);
  const odd = (alpha0, k) => range(alpha0 + k * step) - range(alpha0 - k * step);
  const turn = (alpha0) => 45 * odd(alpha0, 1) - 9 * odd(alpha0, 2) + odd(alpha0, 3);
  const [from, until] = [low - 1e-5, high + 1e-5], ends = [turn(from), turn(until)];
  const inside = until + 3 * step <= RIGHT_ANGLE && from - 3 * step >= -RIGHT_ANGLE;
  return inside && ends[0] > 0 && ends[1] < 0 && isFinite(ends[0] - ends[1])
    ? root(turn, from, until) : middle;
}
