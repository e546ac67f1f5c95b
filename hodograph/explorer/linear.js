// Linear drag, and vacuum: hodograph/engine/linear.py.  With z = v t,
//
//   x = cos(alpha0) t E(z),    y = sin(alpha0) t E(z) - t^2 G(z),
//   E = (1 - exp(-z)) / z,     G = (z - 1 + exp(-z)) / z^2.

// G as a power series in -z for z < 1, highest power first.
const SERIES = [];
for (let k = 0, c = 0.5; k < 18; c /= ++k + 2) SERIES.unshift(c);
const LINEAR_LAST_STEP = 1e-5; // relative: what remains is its cube
const FAST = 2; // downward launches above so many v_lim have a guess of their own
const GUESSES = 6;

function series(z) {
  let G = 0;
  for (const c of SERIES) G = c - z * G;
  return G;
}

// exp(-z), E and G.
function ratios(z) {
  const loss = -expm1(-z);
  if (z >= 1) return [exp(-z), loss / z, (1 - loss / z) / z];
  return [exp(-z), z ? loss / z : 1, series(z)];
}

// x / cos(alpha0), y and t of the apex; sin0 >= 0.
function rise(v, sin0) {
  const q = v * sin0;
  if (!q) return [sin0, 0.5 * sin0 * sin0, sin0];
  const z = log1p(q), t = sin0 * (z / q);
  return [sin0 / (1 + q), z < 1 ? t * t * series(-z) : sin0 * sin0 * ((1 - z / q) / q), t];
}

function climbLinear(v, sin0, cos0) {
  const [x, y, t] = rise(v, max(sin0, 0));
  return { up: [cos0 * x, y, t] };
}

// Time of the fall, to a few percent where it is from an apex.
function firstGuessLinear(v, s, drop) {
  const vacuum = 2 * drop / (s + sqrt(s * s + 2 * drop)), depth = v * (v * drop), q = v * s;
  const ends = [depth, depth + 1 - q];
  let z = v * vacuum;
  z = max(min(z * (1 + z / 6), max(...ends)), min(...ends));
  if (q > FAST) { // Newton in exp(-z), from below
    let highest = depth < q ? -log1p(-depth / q) : Infinity;
    highest = min(highest, depth, max(depth - q + 2, log(q)));
    let falls = exp(-min(highest, 700));
    for (let round = 0; round < GUESSES; round++) {
      const over = (q - 1) * (1 - falls) - log(falls) - depth;
      falls = min(max(falls * (1 + over / (1 + (q - 1) * falls)), 1e-304), 1);
    }
    z = max(-log(falls), depth / q, depth - q + 1, 0);
  }
  return v ? max(z / v, vacuum) : vacuum;
}

// Time of the fall from downward speed s, by Halley's iteration.
function descendLinear(v, s, drop) {
  let time = firstGuessLinear(v, s, drop);
  const bends = 0.5 * (1 - v * s);
  for (let round = 0; round < MAX_STEPS; round++) {
    const [decay, E, G] = ratios(v * time);
    const miss = drop - time * (s * E + time * G), speed = s * decay + time * E;
    const newton = miss / speed;
    const step = newton / (1 + max(min(bends * newton * decay / speed, 0.5), -0.5));
    time = max(time + step, 0.5 * time);
    const near = Math.abs(miss) <= 4 * EPSILON * drop;
    if (near || Math.abs(step) <= LINEAR_LAST_STEP * time) return time;
  }
  return NaN;
}

// As `fly`, for n = 1.
function flyLinear(v, sin0, cos0, height) {
  const [, top, rising] = rise(v, max(sin0, 0)), s = max(-sin0, 0), drop = top + height;
  if (!(drop >= 0)) return null;
  const falling = drop > 0 ? descendLinear(v, s, drop) : 0, t = rising + falling;
  const [decay, E] = ratios(v * t), [slowing, part] = ratios(v * falling);
  const across = cos0 * decay, sinking = s * slowing + falling * part;
  if (Number.isNaN(t)) return null;
  return { x: cos0 * t * E, t, speed: Math.hypot(across, sinking), tangent: sinking / across };
}

// As `course`, with the time as what runs along it.
function courseLinear(v, sin0, cos0) {
  const at = (t) => {
    const [decay, E, G] = ratios(v * t);
    return [cos0 * t * E, sin0 * t * E - t * t * G, t, cos0 * decay, sin0 * decay - t * E];
  };
  const knots = (last, count) => Array.from({ length: count + 1 }, (_, k) => last * (k / count));
  return { at, rate: () => 1, knots, end: v ? TERMINAL / v : Infinity };
}
