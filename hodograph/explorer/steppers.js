// The same launch by fixed steps, as hodograph/steppers.py: the methods of a first course.

const MOST_STEPS = 20000;
const LANDED = "landed", UNSTABLE = "unstable", TOO_MANY = "too many";

// Rows of Butcher's tableau, the weights of the accelerations, and what carries the position: the
// stages' velocities and, last, the new one.  Drag that decays a disturbance at the rate r is followed
// stably while r dt <= reach.
const METHODS = {
  euler: { order: 1, stages: [[]], weights: [1], carry: [1, 0], reach: 2 },
  euler_cromer: { order: 1, stages: [[]], weights: [1], carry: [0, 1], reach: 2 },
  rk2: { order: 2, stages: [[], [1 / 2]], weights: [0, 1], carry: [0, 1, 0], reach: 2 },
  rk4: {
    order: 4, stages: [[], [1 / 2], [0, 1 / 2], [0, 0, 1]],
    weights: [1 / 6, 1 / 3, 1 / 3, 1 / 6], carry: [1 / 6, 1 / 3, 1 / 3, 1 / 6, 0],
    reach: 2.7852935634052822,
  },
};

// Acceleration at a velocity over ground.
function law({ vLim, n, g, wind }) {
  const rate = g / vLim;
  return (p, q) => {
    const a = p - wind, k = n === 1 ? rate : rate * Math.hypot(a, q) / vLim;
    return [-k * a, -k * q - g];
  };
}

// One step of a state [p, q, x, y].
function advance({ stages, weights, carry }, push, dt, [p, q, x, y]) {
  const pushes = [];
  let P = p, Q = q, X = x, Y = y;
  stages.forEach((row, j) => {
    let a = p, b = q;
    row.forEach((part, i) => { a += dt * part * pushes[i][0]; b += dt * part * pushes[i][1]; });
    pushes.push(push(a, b));
    P += dt * weights[j] * pushes[j][0];
    Q += dt * weights[j] * pushes[j][1];
    X += dt * carry[j] * a;
    Y += dt * carry[j] * b;
  });
  const last = dt * carry[stages.length];
  return [P, Q, X + last * P, Y + last * Q];
}

// The nodes from the launch to the first below the ground, and the range: between the last two nodes to
// the method's own order, and `naive`, that of the last node above the ground, as the exercise has it.
function stepped(scene, name, dt, keep = true) {
  const method = METHODS[name], push = law(scene), { v0, alpha0, vLim, n, g, height } = scene;
  const T = Math.tan(scene.slope), wind = vLim < Infinity ? scene.wind : 0;
  const above = (state) => state[3] - state[2] * T;
  const ratio = method.reach / dt / n * (vLim / g);
  const fastest = n === 1 ? (ratio >= 1 ? Infinity : -1) : vLim * ratio ** (1 / (n - 1));
  let state = [v0 * Math.cos(alpha0), v0 * Math.sin(alpha0), 0, height], before = state, steps = 0;
  const nodes = [state];
  const end = (status, x = NaN, naive = NaN) => ({ status, x, naive, steps, nodes });
  const sound = () => Math.hypot(state[0] - wind, state[1]) <= fastest;
  if (!sound()) return end(UNSTABLE);
  while (above(state) >= 0) {
    if (!sound()) return end(UNSTABLE);
    if (++steps > MOST_STEPS) return end(TOO_MANY);
    before = state;
    state = advance(method, push, dt, state);
    if (keep) nodes.push(state);
  }
  if (!state.every(isFinite)) return end(UNSTABLE);
  const line = method.order === 1;
  return end(LANDED, (line ? onLine : onHermite)(before, state, above, push, dt), before[2]);
}

// x where the straight line between the last nodes meets the ground.
function onLine(before, after, above) {
  const part = above(before) / (above(before) - above(after));
  return before[2] + part * (after[2] - before[2]);
}

// The same for the polynomials of degree 5 that have both nodes' position and two rates.
function onHermite(before, after, above, push, dt) {
  const [a0, a1] = [push(before[0], before[1]), push(after[0], after[1])];
  const fit = (axis) => {
    const r0 = before[2 + axis], v0 = dt * before[axis], A0 = dt * dt * a0[axis];
    const d0 = after[2 + axis] - (r0 + v0 + A0 / 2), d1 = dt * after[axis] - (v0 + A0);
    const d2 = dt * dt * a1[axis] - A0;
    return [
      r0, v0, A0 / 2, 10 * d0 - 4 * d1 + d2 / 2, -15 * d0 + 7 * d1 - d2, 6 * d0 - 3 * d1 + d2 / 2,
    ];
  };
  const at = (powers, s) => powers.reduceRight((sum, c) => sum * s + c, 0), [x, y] = [fit(0), fit(1)];
  let low = 0, high = 1;
  for (let round = 0; round < 60; round++) {
    const middle = (low + high) / 2;
    if (above([0, 0, at(x, middle), at(y, middle)]) >= 0) low = middle; else high = middle;
  }
  return at(x, low);
}
