// One launch under quadratic drag: hodograph/engine/scalar.py, function for function.
//
// Units are those of the launch, lengths v0^2/g, times v0/g, speeds v0; v is v0/v_lim, 0 in vacuum.
// delta is how far the slope s = asinh(tan(alpha)) has come down since an arc began, and
// u = 1 + v^2 gap the bracket of eq. 13.  Where Python hands a launch on to its arrays, the rules of
// engine/extremes.py and engine/flight.py stand here.

const EPSILON = 2 ** -52;
const RIGHT_ANGLE = Math.PI / 2;
const COUNTS = [6]; // nodes of the rules on hand
for (let octave = 1; octave < 8; octave++) for (let k = 4; k < 8; k++) COUNTS.push(k << octave);
COUNTS.push(1024);
const NODES_PER_DIGIT = 18.5, NODES_SPARE = 4;
// A step of Newton that changes the fall by no more than the first number, as a factor, is
// integrated in P by so many nodes; one below LAST_STEP by Taylor.
const STEPS = [[1.003, 2], [1.03, 4], [1.15, 6], [2, 12]];
const LAST_STEP = 4e-6, MAX_STEPS = 40;
const TERMINAL = 45; // depth of fall, past the loss of launch speed, where all but y and t is final
const STEEPEST = 300; // growth of tan(alpha) at terminal speed, as a logarithm: the angle is final

const { asinh, atan, exp, expm1, log, log1p, max, min, sqrt } = Math;

const rules = new Map();

// The Gauss-Legendre rule of n nodes on [0, 1], as [nodes, weights]: Newton in theta, x = cos(theta),
// where the weight is well conditioned.
function rule(n) {
  if (rules.has(n)) return rules.get(n);
  const nodes = new Float64Array(n), weights = new Float64Array(n);
  for (let i = 0; i < (n + 1) >> 1; i++) {
    let theta = Math.PI * (4 * i + 3) / (4 * n + 2), slope = 1;
    theta += 1 / (8 * n * n * Math.tan(theta)); // Tricomi
    for (let round = 0; round < 4; round++) {
      const gap = 2 * Math.sin(theta / 2) ** 2; // 1 - x
      let legendre = 1, step = 0;
      for (let k = 0; k < n; k++) { // P_{k+1} - P_k
        step = (k * step - (2 * k + 1) * gap * legendre) / (k + 1);
        legendre += step;
      }
      slope = n * (step - gap * legendre) / Math.sin(theta);
      theta -= legendre / slope;
    }
    nodes[i] = Math.sin(theta / 2) ** 2;
    nodes[n - 1 - i] = 1 - nodes[i];
    weights[i] = weights[n - 1 - i] = 1 / slope ** 2;
  }
  rules.set(n, [nodes, weights]);
  return rules.get(n);
}

const expm1Ratio = (z) => (z ? expm1(z) / z : 1);

// (1 +/- sin(alpha0)) / 2, each to full accuracy.
function halves(sin0, cos0) {
  const far = 0.5 + 0.5 * Math.abs(sin0), near = 0.25 * cos0 * cos0 / far;
  return sin0 >= 0 ? [far, near] : [near, far];
}

// (u - 1) / v^2 after delta.
function bracketGap(sin0, cos0, delta) {
  const [plus, minus] = halves(sin0, cos0);
  const growth = expm1(delta), grown = 1 + growth;
  const bracket = plus * plus / grown + minus * minus * grown;
  return cos0 * cos0 * delta + growth * (1 + 1 / grown) * bracket;
}

// eta, the distance in slope to the singularity behind the launch.
const layer = (v2) => (v2 > 1e-300 ? 0.5 * log1p(1 / v2) : 0.5 * log(1e300));

// ln(rho) of the largest ellipse round tau in [0, length] clear of ln(distance) + i angle.
function ellipse(length, distance, angle) {
  const ahead = log(distance) * (2 / length) - 1, aside = angle * (2 / length);
  const axes = Math.hypot(ahead + 1, aside) + Math.hypot(ahead - 1, aside);
  return Math.acosh(max(axes / 2, 1));
}

// The rule for an arc; w is (v cos(alpha0))^2, tilt sin/cos^2 of alpha0, and slope null for arcs
// that end at their apex or before.
function nodeClass(w, tilt, slope, delta, eta, length) {
  length = max(length, 1e-6);
  let lnRho = ellipse(length, 2.1 / eta, RIGHT_ANGLE);
  if (slope !== null) {
    const a = 1 / max(w, 1e-300) + slope + tilt;
    const steepness = asinh(a / (1 + sqrt(1 + max(a, 0))));
    const turn = slope + max(1.1, steepness) + eta;
    const distance = Math.hypot(turn, RIGHT_ANGLE) / eta;
    lnRho = min(lnRho, ellipse(length, distance, Math.atan2(RIGHT_ANGLE, turn)));
  }
  const wanted = NODES_SPARE
    + max(NODES_PER_DIGIT / max(lnRho, 1e-3), sqrt(NODES_PER_DIGIT * max(delta, length / 2)));
  return rule(COUNTS.find((count) => count >= wanted) ?? 1024);
}

// x / cos(alpha0), y, t over the arc that comes down by delta (eq. 15).
function arc(v2, sin0, cos0, slope, delta) {
  const eta = layer(v2), length = log1p(delta / eta), cos2 = cos0 * cos0;
  const [nodes, weights] = nodeClass(v2 * cos2, sin0 / cos2, slope, delta, eta, length);
  const [plus, minus] = halves(sin0, cos0);
  let x = 0, y = 0, t = 0;
  for (let i = 0; i < nodes.length; i++) {
    const stretch = expm1(length * nodes[i]), at = eta * stretch;
    const growth = expm1(at), grown = 1 + growth;
    const down = plus / grown, C = down + minus * grown;
    const bend = growth * (down + minus), S = sin0 - bend;
    const u = 1 + v2 * (cos2 * at + bend + growth * (down - minus) * S);
    const dx = weights[i] * (stretch + 1) * C / u;
    x += dx;
    y += dx * S;
    t += dx * sqrt(u);
  }
  const scale = eta * length;
  return [scale * x, scale * y, scale * t];
}

// The integrals from the start of a fall, in units of v_x^2 / g.
function fromStart(v2, sin0, cos0, delta) {
  const [x, y, t] = arc(v2, sin0, cos0, asinh(sin0 / cos0), delta);
  return [x / cos0, y / (cos0 * cos0), t / cos0];
}

// F(p) - p^2.
const thickness = (p, secant) => p / (secant + p) + asinh(p);

// P - P_start to some percent.
function firstGuess(PStart, w, drop, least) {
  const start = PStart ? thickness(sqrt(PStart), sqrt(1 + PStart)) : 0;
  let gain = least;
  for (let round = 0; round < 2; round++) {
    const P = PStart + gain, p = sqrt(P);
    const mean = (thickness(p, sqrt(1 + P)) - start) * (2 / 3 + p) / (1 + p);
    gain = max((1 + w * mean) * least, least);
  }
  if (PStart) {
    const steepest = 2 * w * sqrt(1 + 1 / PStart) * drop;
    if (steepest < 700) gain = min(gain, 2 * drop * expm1Ratio(steepest));
  }
  return gain;
}

// asinh(sqrt(P1)) - asinh(sqrt(P0)), without subtracting the two.
function slopeGain(P0, P1, gain) {
  if (!P0) return asinh(sqrt(P1));
  return asinh(gain / (sqrt(P1) * sqrt(1 + P0) + sqrt(P0) * sqrt(1 + P1)));
}

// P = tan^2(alpha), delta, u and the sums after a fall by `drop`, by Newton on
// h = expm1(2 w miss) / 2 w with two terms more; null if it does not converge.
function descend(v2, sin0, cos0, drop) {
  const w = v2 * cos0 * cos0, PStart = (sin0 / cos0) ** 2;
  const least = 2 * drop * expm1Ratio(2 * w * drop);
  let gain = firstGuess(PStart, w, drop, least), P = PStart + gain;
  let delta = slopeGain(PStart, P, gain);
  let [x, y, t] = fromStart(v2, sin0, cos0, delta);
  for (let round = 0; round < MAX_STEPS; round++) {
    const p = sqrt(P), secant = sqrt(1 + P);
    let u = 1 + v2 * bracketGap(sin0, cos0, delta);
    const miss = drop + y, h = miss * expm1Ratio(2 * w * miss);
    const turn = w * secant / p, first = turn - w, c = first * h; // turn is du/dP
    const d = 2 / 3 * h * h * (first * (first - w) - 0.5 * u * w / (P * p * secant));
    const bend = max(min(c - c * c + d, 0.5), -0.5);
    const step = max(2 * u * h / (1 - bend), least - gain), now = gain;
    gain += step;
    if (Math.abs(step) <= LAST_STEP * gain) {
      x += miss / p * (1 - 0.5 * miss * u / P);
      t += miss / p * sqrt(u) * (1 + 0.5 * miss * (turn - u / P));
      u += step * (turn - 0.25 * w / (P * p * secant) * step);
      P = PStart + gain;
      return { P, u, fallDelta: slopeGain(PStart, P, gain), fall: [x, -drop, t] };
    }
    const next = PStart + gain;
    delta = slopeGain(PStart, next, gain);
    const short = STEPS.find(([longest]) => gain <= longest * now && now <= longest * gain);
    if (short) {
      const [dx, dy, dt] = shortStep(rule(short[1]), P, u, w, step);
      x += dx; y -= dy; t += dt;
    } else {
      [x, y, t] = fromStart(v2, sin0, cos0, delta);
    }
    P = next;
  }
  return null;
}

// What a short step in P adds to x, -y and t.
function shortStep([nodes, weights], P0, u0, w, step) {
  const p0 = sqrt(P0), secant0 = sqrt(1 + P0);
  let x = 0, y = 0, t = 0;
  for (let i = 0; i < nodes.length; i++) {
    const dP = step * nodes[i], P = P0 + dP, p = sqrt(P), secant = sqrt(1 + P);
    const dF = dP * (1 + P + P0) / (p * secant + p0 * secant0);
    const u = u0 + w * (dF + asinh(dP / (p * secant0 + p0 * secant)));
    const dy = weights[i] / u, dx = dy / p;
    x += dx;
    y += dy;
    t += dx * sqrt(u);
  }
  return [0.5 * step * x, 0.5 * step * y, 0.5 * step * t];
}

// The rise: x, y, t of the apex above the launch, and (v_x / v0)^2 there; all of the launch itself
// if it is not upward.
function climb(v, sin0, cos0) {
  const v2 = v * v;
  if (!(sin0 > 0)) return { slope: 0, up: [0, 0, 0], across2: cos0 * cos0 };
  const slope = asinh(sin0 / cos0), [x, y, t] = arc(v2, sin0, cos0, null, slope);
  const across2 = cos0 * cos0 / (1 + v2 * bracketGap(sin0, cos0, slope));
  return { slope, up: [cos0 * x, y, t], across2 };
}

// The landing `height` below the launch: x, t, speed and tangent = -tan(alpha); null where it is
// never reached.
function fly(v, sin0, cos0, height) {
  const { up, across2 } = climb(v, sin0, cos0), fall = up[1] + height;
  if (!(fall >= 0)) return null;
  if (fall === 0) { // at the apex, or at once
    const speed = sin0 < 0 ? 1 : sqrt(across2);
    return { x: up[0], t: up[2], speed, tangent: -min(sin0, 0) / cos0 };
  }
  const [topV2, sinTop, cosTop] = sin0 < 0 ? [v * v, sin0, cos0] : [v * v * across2, 0, 1];
  const deepest = TERMINAL + 0.5 * log(max(topV2, 1)), beyond = max(v * v * fall - deepest, 0);
  const shown = beyond > 0 ? deepest / (v * v) : fall;
  const down = descend(topV2, sinTop, cosTop, shown / across2);
  if (!down) return null;
  const { P, u, fall: [x, , t] } = down, speed = sqrt(across2 * (1 + P) / u);
  const drift = beyond > 0 ? speed / sqrt(1 + P) * -expm1(-beyond) / v : 0;
  return {
    x: up[0] + across2 * x + drift,
    t: up[2] + sqrt(across2) * t + (beyond > 0 ? beyond / v : 0),
    speed,
    tangent: sqrt(P) * exp(min(beyond, STEEPEST)),
  };
}

// The whole way as a function of delta, for what meets it elsewhere than on level ground: `at` gives
// [x, y, t, v_x, v_y], `rate` is dt/d(delta), and past `end` it goes straight down at terminal speed.
function course(v, sin0, cos0) {
  const v2 = v * v, slope0 = asinh(sin0 / cos0), { slope, up, across2 } = climb(v, sin0, cos0);
  const root = (delta) => sqrt(1 + v2 * bracketGap(sin0, cos0, delta));
  const at = (delta) => {
    const vx = cos0 / root(delta), vy = vx * Math.sinh(slope0 - delta);
    if (sin0 > 0 && delta > slope) {
      const [x, y, t] = arc(v2 * across2, 0, 1, 0, delta - slope);
      return [up[0] + across2 * x, up[1] + across2 * y, up[2] + sqrt(across2) * t, vx, vy];
    }
    const [x, y, t] = arc(v2, sin0, cos0, sin0 > 0 ? null : slope0, delta);
    return [cos0 * x, y, t, vx, vy];
  };
  const rate = (delta) => cos0 * Math.cosh(slope0 - delta) / root(delta);
  const steep = asinh(1 / (v * sqrt(across2))); // where a fall from there is about terminal
  const end = slope + max(steep + min(slope0, 0), 0) + TERMINAL;
  // Places along it, dense where drag acts and where it turns.
  const knots = (last, count) => {
    const parts = [[0, min(slope, last), v2], [slope, last, v2 * across2]], places = [0];
    for (const [first, until, w] of parts) {
      const span = until - first, eta = layer(w), length = log1p(span / eta);
      if (!(span > 0)) continue;
      for (let k = 1; k <= count; k++) places.push(first + span * (k / count));
      for (let k = 1; k < count; k++) places.push(first + eta * expm1(length * (k / count)));
    }
    return places.sort((a, b) => a - b);
  };
  return { at, rate, knots, end };
}
