// What the page is set to: its quantities and their ranges, and the address that carries all of it.

// Each slider runs from 0 to 1; `from` gives its value and `to` its place.  A square gives small
// values more room, a logarithm all of them alike.
const straight = (least, most) => ({
  from: (s) => least + s * (most - least), to: (q) => (q - least) / (most - least),
});
const square = (least, most) => {
  const sign = least < 0, from = (s) => (sign ? (2 * s - 1) * Math.abs(2 * s - 1) : s * s) * most;
  return { from, to: (q) => (sign ? (1 + Math.sign(q) * sqrt(Math.abs(q) / most)) / 2 : sqrt(q / most)) };
};
const even = (least, most) => ({
  from: (s) => least * (most / least) ** s, to: (q) => log(q / least) / log(most / least),
});
const quantity = (least, most, usual, unit, scale = null) =>
  ({ least, most, usual, unit, ...(scale && { slide: scale(least, most) }) });

const QUANTITIES = {
  v0: quantity(0, 1000, 40, "m/s", square),
  angle: quantity(-90, 90, 40, "°", straight),
  v_lim: quantity(0.01, 1e4, 42.7, "m/s", even),
  mass: quantity(1e-4, 100, 0.145, "kg", even),
  cd: quantity(0, 2, 0.35, "", straight),
  diameter: quantity(1e-3, 2, 0.0737, "m", even),
  rho: quantity(0, 1000, 1.225, "kg/m³"),
  height: quantity(-1000, 1000, 0, "m", square),
  wind: quantity(-50, 50, 0, "m/s", straight),
  slope: quantity(-80, 80, 0, "°", straight),
  g: quantity(0.01, 100, 9.81, "m/s²"),
  dt: quantity(1e-3, 1, 0.1, "s", even),
};
const BODY = ["mass", "cd", "diameter"];
const MOST_KEPT = 5;
// What of a scene is kept, in the order in which the address has it.
const KEPT = ["v0", "angle", "v_lim", "n", "height", "wind", "slope", "g"];

const usual = () => ({
  ...Object.fromEntries(Object.entries(QUANTITIES).map(([name, { usual }]) => [name, usual])),
  drag: "speed", n: 2, lang: navigator.language.startsWith("fr") ? "fr" : "en", vacuum: true,
  methods: false, kept: [],
});
let state = usual();

const radians = (degrees) => degrees * (Math.PI / 180);

// A number of this quantity from a text, brought into its range; null if it is none.
function read(name, text) {
  const value = String(text).trim() === "" ? NaN : Number(text), { least, most } = QUANTITIES[name];
  return Number.isNaN(value) ? null : min(max(value, least), most);
}

// The terminal speed, by whichever way it is given (eq. 12).
function terminalSpeed({ drag, v_lim, mass, cd, diameter, rho, g }) {
  if (drag === "none") return Infinity;
  if (drag === "speed") return v_lim;
  return sqrt(8 * mass * g / (Math.PI * rho * cd * diameter * diameter));
}

// The scene of engine and formulas.
const sceneOf = ({ v0, angle, v_lim, n, height, wind, slope, g }) => ({
  v0, alpha0: radians(angle), vLim: v_lim, n, g, height, slope: radians(slope), wind,
});
const setting = () => ({
  ...Object.fromEntries(KEPT.map((name) => [name, state[name]])), v_lim: terminalSpeed(state),
});

// The part of the address after #.
function toHash() {
  const parts = [`v0=${state.v0}`, `angle=${state.angle}`], { drag } = state;
  if (drag === "body") for (const name of BODY) parts.push(`${name}=${state[name]}`);
  else parts.push(`v_lim=${drag === "none" ? "inf" : state.v_lim}`);
  for (const name of ["rho", "height", "wind", "slope", "g", "dt"]) {
    if (state[name] !== QUANTITIES[name].usual) parts.push(`${name}=${state[name]}`);
  }
  if (state.n !== 2) parts.push(`n=${state.n}`);
  if (!state.vacuum) parts.push("vacuum=0");
  if (state.methods) parts.push("methods=1");
  parts.push(`lang=${state.lang}`);
  const kept = state.kept.map((one) => KEPT.map((name) => one[name]).join(","));
  if (kept.length) parts.push(`keep=${kept.join(";")}`);
  return `#${parts.join("&")}`.replaceAll("Infinity", "inf");
}

// The state that such an address asks for.  What is no number, or not known, is left as it usually is;
// what is out of its range is brought into it.
function fromHash(hash) {
  const asked = new Map(), made = { ...usual(), lang: state.lang };
  for (const part of hash.replace(/^#/, "").split("&")) {
    const [name, ...value] = part.split("=");
    asked.set(name, value.join("=").replace(/%2C/gi, ",").replace(/%3B/gi, ";"));
  }
  const endless = (text) => /^[+]?inf(inity)?$/i.test(text);
  for (const name of Object.keys(QUANTITIES)) {
    made[name] = asked.has(name) ? read(name, asked.get(name)) ?? made[name] : made[name];
  }
  if (BODY.some((name) => asked.has(name))) made.drag = "body";
  const speed = asked.get("v_lim") ?? "";
  if (endless(speed)) [made.drag, made.v_lim] = ["none", QUANTITIES.v_lim.usual];
  else if (read("v_lim", speed) !== null) made.drag = "speed";
  if (asked.get("n") === "1") made.n = 1;
  made.vacuum = asked.get("vacuum") !== "0";
  made.methods = asked.get("methods") === "1";
  if (Object.hasOwn(WORDS, asked.get("lang"))) made.lang = asked.get("lang");
  for (const text of (asked.get("keep") ?? "").split(";").slice(0, MOST_KEPT)) {
    const values = text.split(",");
    const one = Object.fromEntries(KEPT.map((name, k) => {
      if (name === "n") return [name, Number(values[k]) === 1 ? 1 : 2];
      // the terminal speed of a body may be any
      const speed = Number(values[k]);
      if (name === "v_lim" && speed > 0) return [name, min(max(speed, 1e-4), 1e9)];
      return [name, endless(values[k]) && name === "v_lim" ? Infinity : read(name, values[k] ?? "")];
    }));
    if (Object.values(one).every((value) => value !== null)) made.kept.push(one);
  }
  return made;
}
