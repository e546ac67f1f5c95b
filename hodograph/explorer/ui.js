// The page at work: controls to state, state to picture and numbers, play.

let drawn = null; // what is in the picture: scene, landing, points, view
let waiting = false, saving = 0, speaking = true; // whether the words are to be put up again
let playing = 0; // the clock at which the flight began, in ms; 0 when it stands
let standing = 0; // where on its way the ball stands, in s

function schedule() {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => { waiting = false; render(); });
}

// --- controls ------------------------------------------------------------------------------

// A row for each quantity: label, slider, number, unit.
function buildControls() {
  for (const row of document.querySelectorAll("[data-quantity]")) {
    const name = row.dataset.quantity, { least, most, unit, slide } = QUANTITIES[name];
    row.className = slide ? "quantity" : "quantity plain";
    row.innerHTML = `<label for="${name}" data-word="${name}"></label>`
      + (slide ? `<input type="range" id="${name}-slider" data-label="${name}" max="1" step="0.001">` : "")
      + `<input type="number" id="${name}" min="${least}" max="${most}" step="any">`
      + `<span class="unit" aria-hidden="true">${unit}</span>`;
    const number = $(name), slider = $(`${name}-slider`);
    number.addEventListener("input", () => set(name, read(name, number.value), number));
    number.addEventListener("change", () => showValue(name));
    slider?.addEventListener("input", () => {
      set(name, rounded(name, slide.from(Number(slider.value))), slider);
    });
  }
}

// Three digits are enough from a slider, and an end is the end.
function rounded(name, value) {
  const { least, most } = QUANTITIES[name], near = Number(value.toPrecision(3));
  return min(max(Math.abs(near) < 1e-9 ? 0 : near, least), most);
}

// The body of the list that the state is, or none.
const bodyKey = () => {
  const same = (key) => BODY.every((name) => BODIES[key][name] === state[name]);
  return Object.keys(BODIES).find(same) ?? "";
};

function showValue(name, but = null) {
  const number = $(name), slider = $(`${name}-slider`), { slide, unit } = QUANTITIES[name];
  if (number !== but) number.value = state[name];
  if (!slider) return;
  if (slider !== but) slider.value = slide.to(state[name]);
  slider.setAttribute("aria-valuetext", `${state[name]} ${unit}`);
}

function set(name, value, from = null) {
  if (value === null) return;
  state[name] = value;
  if (BODY.includes(name)) $("bodies").value = bodyKey();
  $("best-said").textContent = "";
  if (QUANTITIES[name]) showValue(name, from);
  stop();
  schedule();
}

// All controls to the state, after a link, a reset or a kept path.
function showState() {
  for (const name of Object.keys(QUANTITIES)) showValue(name);
  for (const name of ["drag", "n"]) {
    for (const radio of document.getElementsByName(name)) {
      radio.checked = radio.value === String(state[name]);
    }
  }
  $("lang").value = state.lang;
  $("show-vacuum").checked = state.vacuum;
  $("show-methods").checked = state.methods;
  $("best-said").textContent = "";
  speaking = true;
  stop();
  schedule();
}

function speak() {
  speaking = false;
  listKept();
  document.documentElement.lang = state.lang;
  document.title = `${word("title")} · hodograph`;
  for (const one of document.querySelectorAll("[data-word]")) one.textContent = word(one.dataset.word);
  for (const one of document.querySelectorAll("[data-label]")) {
    one.setAttribute("aria-label", word(one.dataset.label));
  }
  const names = WORDS[state.lang].bodies ?? {};
  $("bodies").innerHTML = `<option value="">${word("own")}</option>`
    + Object.entries(BODIES).map(([key, { name }]) =>
      `<option value="${key}">${names[key] ?? name}</option>`).join("");
  $("bodies").value = bodyKey();
  $("play").textContent = word(playing ? "stop" : "play");
}

// --- the frame ------------------------------------------------------------------------------

function render() {
  if (speaking) speak();
  const now = setting(), scene = sceneOf(now), landing = meet(scene), points = path(scene, landing);
  const empty = { ...scene, vLim: Infinity }, free = meet(empty), freely = path(empty, free);
  for (const part of document.querySelectorAll("[data-for]")) {
    part.hidden = !part.dataset.for.split(" ").includes(state.drag);
  }
  $("v_lim-said").textContent = digits(now.v_lim, 4);

  const top = apex(scene), runs = compareMethods(scene, landing);
  const kept = state.kept.map((one) => ({ scene: sceneOf(one), points: keptPath(one) }));
  const svg = $("scene"), visible = [points, ...kept.map((one) => one.points)];
  if (state.vacuum) visible.push(freely);
  const { width, height } = svg.getBoundingClientRect();
  const view = makeView([...visible.flat(), { x: 0, y: 0 }], max(width, 200), max(height, 150));
  svg.setAttribute("viewBox", `0 0 ${view.width} ${view.height}`);
  drawGround(view, scene);
  $("path").setAttribute("d", curve(view, points));
  $("vacuum").setAttribute("d", state.vacuum ? curve(view, freely) : "");
  $("kept-paths").innerHTML = kept.map(({ points: way }, k) => {
    const end = way.at(-1);
    return `<path class="path kept-${k + 1}" d="${curve(view, way)}"/>`
      + text(view.X(end.x), view.Y(end.y) + 16, k + 1, `kept-${k + 1}`);
  }).join("");
  const stepping = ([name, run]) => steppedPath(view, run.nodes, name);
  $("stepped").innerHTML = state.methods ? runs.map(stepping).join("") : "";
  const risen = top.t > 0 && (!landing || top.t <= landing.t);
  $("marks").innerHTML = launchArrow(view, scene)
    + (risen ? apexMark(view, top) : "")
    + (landing ? landingMark(view, landing) : "");

  drawn = { scene, landing, points, freely, view };
  numbers(now, scene, landing, free, top, risen);
  drawMap(scene.v0 / scene.vLim, scene.alpha0, scene.n);
  if (!playing) place(standing);
  later(() => {
    save();
    drawConvergence(scene, landing);
    $("spoken").textContent = $("scene-words").textContent; // once, for those who listen
  });
}

// What can wait until the sliders rest.
function later(work) {
  clearTimeout(saving);
  saving = setTimeout(work, 150);
}

const keptPaths = new WeakMap();
function keptPath(one) {
  if (!keptPaths.has(one)) keptPaths.set(one, path(sceneOf(one), meet(sceneOf(one))));
  return keptPaths.get(one);
}

function numbers(now, scene, landing, free, top, risen) {
  const v = scene.v0 / scene.vLim, d = dNorm(v, scene.alpha0, scene.n);
  const say = (id, words) => { $(id).textContent = words; };
  const exact = landing ? plain(landing.x) : "–", size = shownDigits(exact);
  $("range").innerHTML = `${exact.slice(0, size)}<span class="fine">${exact.slice(size)}</span>`;
  say("time", landing ? shown(landing.t, 4) : "–");
  say("apex", risen || !top.t ? shown(top.y, 4) : "–");
  say("apex-x", risen || !top.t ? shown(top.x, 4) : "–");
  say("speed", landing ? shown(Math.hypot(landing.vx, landing.vy), 4) : "–");
  say("alpha", landing ? shown(landing.alpha * 180 / Math.PI, 4) : "–");
  say("range-vacuum", free ? shown(free.x, 5) : "–");
  say("v_norm", digits(v, 4));
  say("d_norm", isFinite(d) ? d.toFixed(5) : "–");
  const never = landing ? "" : word(top.y < 0 || scene.height < 0 ? "short" : "unreachable");
  say("status", never);
  say("said", `${described(now)}.`);
  const told = [["range", "range", "m"], ["flightTime", "time", "s"], ["apexHeight", "apex", "m"]]
    .map(([name, id, unit]) => `${word(name)} ${$(id).textContent} ${unit}`);
  say("scene-words", `${never || `${told.join(", ")}.`} ${described(now)}.`);
}

// Ten digits, as plain text; what no ruler sees is none.
function plain(x) {
  if (Math.abs(x) < 1e-9) return "0.000000000";
  return x.toPrecision(10);
}

// How many characters of it are worth a large type: four digits.
function shownDigits(words) {
  const [, whole] = /^(-?\d+)/.exec(words) ?? [, ""], count = whole.replace("-", "").length;
  return count >= 4 ? whole.length : whole.length + 1 + (4 - count);
}

// --- play --------------------------------------------------------------------------------------

// The balls at time t: one with drag, one without.
function place(t) {
  if (!drawn) return;
  standing = t;
  const { view, points, freely, landing } = drawn, last = points.at(-1).t;
  const ball = along(points, min(t, last));
  const ghost = along(freely, min(t, freely.at(-1).t));
  for (const [id, at, on] of [["ball", ball, true], ["ghost", ghost, state.vacuum]]) {
    $(id).setAttribute("cx", px(view.X(at.x)));
    $(id).setAttribute("cy", px(view.Y(at.y)));
    $(id).style.display = on && (t > 0 || id === "ball") ? "" : "none";
  }
  const whole = max(last, state.vacuum ? freely.at(-1).t : 0);
  $("clock").value = whole ? 1000 * t / whole : 0;
  $("clock").setAttribute("aria-valuetext", `${t.toFixed(2)} s`);
  $("now").textContent = `${t.toFixed(2)} s`;
  return t < whole && (landing || t < last);
}

function tickOn(at) {
  if (!playing) return;
  if (place(max((at - playing) / 1000, 0))) requestAnimationFrame(tickOn); else stop(standing);
}

function stop(at = 0) {
  [playing, standing] = [0, at];
  $("play").textContent = word("play");
}

// --- everything that can be pressed ---------------------------------------------------------

const actions = {
  play() {
    if (playing) return void (stop(), place(0));
    playing = performance.now();
    $("play").textContent = word("stop");
    requestAnimationFrame(tickOn);
  },
  keep() {
    if (state.kept.length < MOST_KEPT) state.kept.push(setting());
    listKept();
    schedule();
  },
  best() {
    const alpha0 = bestAngle(sceneOf(setting()));
    if (alpha0 === null) return void ($("best-said").textContent = word("noBest"));
    set("angle", Number((alpha0 * 180 / Math.PI).toFixed(9)));
    $("best-said").textContent = `${state.angle.toFixed(4)}° ${word("bestSaid")}`;
  },
  async copy() {
    save();
    let said = "copied";
    try { await navigator.clipboard.writeText(location.href); } catch { said = "notCopied"; }
    $("copy").textContent = word(said);
    setTimeout(() => { $("copy").textContent = word("copy"); }, 1500);
  },
  theme() { darken(document.documentElement.dataset.theme !== "dark"); },
};

function darken(dark) {
  document.documentElement.dataset.theme = dark ? "dark" : "light";
  $("theme").setAttribute("aria-pressed", String(dark));
}

let saved = null;
function save() {
  saved = toHash();
  try { history.replaceState(null, "", saved); } catch { /* a page that may not change its address */ }
}

function load() {
  if (location.hash === saved) return;
  state = fromHash(location.hash);
  showState();
}

function begin() {
  buildControls();
  for (const [name, action] of Object.entries(actions)) $(name).addEventListener("click", action);
  $("controls").addEventListener("reset", (event) => {
    event.preventDefault();
    state = { ...usual(), lang: state.lang, kept: state.kept, methods: state.methods };
    showState();
  });
  $("controls").addEventListener("submit", (event) => event.preventDefault());
  for (const name of ["drag", "n"]) {
    for (const radio of document.getElementsByName(name)) {
      radio.addEventListener("change", () => set(name, name === "n" ? Number(radio.value) : radio.value));
    }
  }
  $("bodies").addEventListener("change", () => {
    const body = BODIES[$("bodies").value];
    if (body) for (const [name, value] of BODY.map((name) => [name, body[name]])) set(name, value);
  });
  $("lang").addEventListener("change", () => { state.lang = $("lang").value; showState(); });
  for (const name of ["vacuum", "methods"]) {
    $(`show-${name}`).addEventListener("change", ({ target }) => {
      state[name] = target.checked;
      schedule();
    });
  }
  $("kept").addEventListener("click", ({ target }) => {
    const { show, remove } = target.dataset;
    if (remove) {
      state.kept.splice(Number(remove), 1);
      listKept();
      $("keep").focus();
      schedule();
    }
    if (show) {
      const { v_lim, ...rest } = state.kept[Number(show)], drag = v_lim < Infinity ? "speed" : "none";
      Object.assign(state, rest, { drag, ...(drag === "speed" && { v_lim: read("v_lim", v_lim) }) });
      showState();
    }
  });
  $("clock").addEventListener("input", () => {
    stop();
    const whole = max(drawn.points.at(-1).t, state.vacuum ? drawn.freely.at(-1).t : 0);
    place(whole * $("clock").value / 1000);
  });
  // A mouse aims in the picture; a finger scrolls the page.
  for (const kind of ["pointerdown", "pointermove"]) {
    $("scene").addEventListener(kind, (event) => {
      if (event.pointerType === "touch" || !(event.buttons & 1) || !drawn) return;
      const box = $("scene").getBoundingClientRect(), { view, scene } = drawn;
      const x = event.clientX - box.left - view.X(0), y = view.Y(scene.height) - (event.clientY - box.top);
      const degrees = Math.atan2(y, max(x, 0)) * 180 / Math.PI;
      if (x || y) set("angle", Number(degrees.toFixed(1)));
    });
  }
  $("map-over").addEventListener("click", (event) => {
    const { left, top, width, tall } = mapBox(), box = $("map-over").getBoundingClientRect();
    const at = (event.clientX - box.left - left) / width, up = 1 - (event.clientY - box.top - top) / tall;
    const { v_lim } = setting(), end = mapEnd(state.v0 / v_lim);
    if (v_lim < Infinity) set("v0", read("v0", Number((min(max(at, 0), 1) * end * v_lim).toPrecision(4))));
    set("angle", Number((90 * min(max(up, 0), 1)).toFixed(1)));
  });
  const dim = matchMedia("(prefers-color-scheme: dark)");
  darken(dim.matches);
  dim.addEventListener("change", () => darken(dim.matches));
  addEventListener("hashchange", load);
  new ResizeObserver(schedule).observe(document.body);
  load();
}

begin();
