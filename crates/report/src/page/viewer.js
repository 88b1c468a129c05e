// Two images under one divider. State in one object, one draw function.
const REFERENCE = "#reference";
// Error maps start with the full colour at a quarter.
const SENSITIVITY = 2;
// Largest zoom, in device pixels per image pixel.
const MOST = 64;

function startViewer() {
  const $ = (id) => document.getElementById(id);
  const stage = $("v-stage");
  const canvas = $("v-canvas");
  const state = { scene: 0, level: 0, a: "", b: "", view: "image", exposure: 0, gain: SENSITIVITY, zoom: 0, x: 0.5, y: 0.5, wipe: 0.5 };
  let shown = null;
  let turn = 0;

  const scene = () => gallery.scenes[state.scene];
  const level = () => scene().levels[state.level];
  const rows = () => gallery.labels.filter((l) => l in (level()?.images ?? {}));
  const isMap = () => state.view === "magnitude" || state.view === "signed";

  // Entries are [value, text], or [group's name, entries].
  function options(select, entries, value) {
    const option = ([v, text]) => new Option(text, v, false, v === value);
    select.replaceChildren(...entries.map((entry) => {
      if (!Array.isArray(entry[1])) return option(entry);
      const group = document.createElement("optgroup");
      group.label = entry[0];
      group.append(...entry[1].map(option));
      return group;
    }));
  }

  // The chosen diagnostic as {label, name}, or null. Its view is `diagnostic ` and both as JSON.
  function diagnostic() {
    if (!state.view.startsWith("diagnostic ")) return null;
    const [label, name] = JSON.parse(state.view.slice(11));
    return { label, name };
  }

  function fillChoices() {
    options($("v-scene"), gallery.scenes.map((s, i) => [String(i), s.title]), String(state.scene));
    options($("v-spp"), scene().levels.map((l, i) => [String(i), String(l.spp)]), String(state.level));
    const sides = rows().map((l) => [l, l]);
    if (scene().reference !== null) sides.push([REFERENCE, "reference"]);
    const known = (l) => sides.some(([v]) => v === l);
    if (!known(state.a)) state.a = sides[0]?.[0] ?? "";
    if (!known(state.b)) state.b = sides[1]?.[0] ?? state.a;
    options($("v-a"), sides, state.a);
    options($("v-b"), sides, state.b);
    const views = [["image", "Image"]];
    if (scene().reference !== null) views.push(["magnitude", "Relative error"], ["signed", "Signed difference"]);
    const of = level()?.diagnostics ?? {};
    for (const label of gallery.labels.filter((l) => l in of)) {
      const names = Object.keys(of[label]).sort();
      views.push([label, names.map((name) => [`diagnostic ${JSON.stringify([label, name])}`, name])]);
    }
    const all = views.flatMap(([v, entries]) => (Array.isArray(entries) ? entries.map(([d]) => d) : [v]));
    if (!all.includes(state.view)) state.view = "image";
    options($("v-view"), views, state.view);
  }

  // Index of the image of a side, and how to paint it.
  function source(label) {
    if (label === REFERENCE) return { index: scene().reference, view: isMap() ? state.view : "image" };
    const chosen = diagnostic();
    if (chosen) {
      const index = level().diagnostics[label]?.[chosen.name];
      if (index !== undefined) return { index, view: gallery.images[index].channels === 1 ? "range" : "image", diagnostic: true };
      return { index: level().images[label], view: "image" };
    }
    return { index: level().images[label], view: state.view };
  }

  async function refresh() {
    const mine = ++turn;
    fillChoices();
    showControls();
    try {
      const chosen = diagnostic();
      if (chosen && ![state.a, state.b].some((l) => level().diagnostics[l]?.[chosen.name] !== undefined)) {
        const [a, b] = [state.a, state.b].map((l) => (l === REFERENCE ? "the reference" : l));
        const sides = a === b ? `${a} does not have this image` : `Neither ${a} nor ${b} has this image`;
        throw new Error(`${sides}: ${chosen.name} is one of ${chosen.label}.`);
      }
      const reference = scene().reference === null ? null : await imageAt(scene().reference);
      const sides = [];
      for (const label of [state.a, state.b]) {
        const { index, view, diagnostic } = source(label);
        if (index === undefined || index === null) throw new Error("This image is not in the page.");
        const image = await imageAt(index);
        const fits = reference && reference.width === image.width && reference.height === image.height;
        const gain = view === "image" ? state.exposure : view === "range" ? 0 : state.gain;
        sides.push({ label, image, view, diagnostic, ...paint(image, reference, fits || !isMap() ? view : "image", gain) });
      }
      if (mine !== turn) return;
      shown = { sides, reference };
      $("v-problem").hidden = true;
      showBar();
      draw();
    } catch (error) {
      if (mine !== turn) return;
      shown = null;
      canvas.getContext("2d").clearRect(0, 0, canvas.width, canvas.height);
      if (canvas.height < 100) canvas.height = 100;
      $("v-bar").hidden = true;
      $("v-problem").hidden = false;
      $("v-problem").textContent = error.message;
    }
  }

  function showControls() {
    const gain = isMap() ? state.gain : state.exposure;
    $("v-gain").value = gain;
    $("v-gain-name").textContent = isMap() ? "Sensitivity" : "Exposure";
    $("v-gain-text").textContent = isMap() ? `${(2 ** gain).toPrecision(3)}×` : `${gain < 0 ? "−" : "+"}${Math.abs(gain).toFixed(2)} EV`;
    $("v-wipe").value = 100 * state.wipe;
    const chosen = diagnostic()?.name;
    const single = chosen && [state.a, state.b].some((l) => gallery.images[level()?.diagnostics[l]?.[chosen]]?.channels === 1);
    $("v-gain").disabled = Boolean(single);
    const name = (label) => {
      if (chosen && level()?.diagnostics[label]?.[chosen] !== undefined) return `${label} · ${chosen}`;
      const value = level()?.values[label];
      return label === REFERENCE ? "reference" : value ? `${label} · ${gallery.metric} ${value}` : label;
    };
    $("v-name-a").textContent = `A  ${name(state.a)}`;
    $("v-name-b").textContent = `B  ${name(state.b)}`;
    const crop = scene().crop;
    $("v-note").textContent = crop
      ? `The page carries ${crop[2]}×${crop[3]} pixels of this frame, starting at column ${crop[0]}, row ${crop[1]}. Errors in the badges are of the whole frame, over all replicates; images are of the first replicate.`
      : "Errors in the badges are over all replicates; images are of the first replicate.";
  }

  function showBar() {
    const range = shown.sides.find((s) => s.view === "range");
    const table = state.view === "signed" ? SIGNED : MAGNITUDE;
    $("v-bar").hidden = !(isMap() || range);
    const pixels = new ImageData(256, 1);
    for (let i = 0; i < 256; i++) pixels.data.set([table[3 * i], table[3 * i + 1], table[3 * i + 2], 255], 4 * i);
    $("v-bar-canvas").getContext("2d").putImageData(pixels, 0, 0);
    const full = 2 ** -state.gain;
    const text = (v) => `${Number(v.toPrecision(3))}`.replace("-", "−");
    if (isMap()) {
      $("v-bar-low").textContent = state.view === "signed" ? `${text(-full)} too dark` : "0";
      $("v-bar-high").textContent = state.view === "signed" ? `${text(full)} too bright` : `${text(full)} or more`;
    } else if (range) {
      $("v-bar-low").textContent = text(range.low);
      $("v-bar-high").textContent = text(range.high);
    }
  }

  // Zoom counts device pixels per image pixel, so that image pixels stay square and sharp.
  function geometry() {
    const ratio = window.devicePixelRatio || 1;
    const { width, height } = shown.sides[0].image;
    const room = Math.max(1, Math.round(stage.clientWidth * ratio));
    const tallest = Math.max(200, Math.round(0.78 * window.innerHeight * ratio));
    const fit = Math.max(1, Math.min(Math.floor(room / width), Math.floor(tallest / height)));
    const zoom = state.zoom || fit;
    return { ratio, width, height, room, fit, zoom, tall: Math.min(tallest, height * fit) };
  }

  function draw() {
    if (!shown) return;
    const g = geometry();
    if (canvas.width !== g.room || canvas.height !== g.tall) {
      canvas.width = g.room;
      canvas.height = g.tall;
      canvas.style.height = `${g.tall / g.ratio}px`;
    }
    const pannable = g.width * g.zoom > g.room || g.height * g.zoom > g.tall;
    stage.classList.toggle("zoomed", pannable);
    const place = (room, size, center) => {
      const full = size * g.zoom;
      if (full <= room) return Math.floor((room - full) / 2);
      return Math.round(Math.min(0, Math.max(room - full, room / 2 - center * full)));
    };
    const left = place(g.room, g.width, state.x);
    const top = place(g.tall, g.height, state.y);
    const context = canvas.getContext("2d");
    context.imageSmoothingEnabled = false;
    context.clearRect(0, 0, g.room, g.tall);
    const split = Math.round(left < 0 ? g.room * state.wipe : left + g.width * g.zoom * state.wipe);
    const halves = [[0, split], [split, g.room - split]];
    shown.sides.forEach((side, i) => {
      context.save();
      context.beginPath();
      context.rect(halves[i][0], 0, halves[i][1], g.tall);
      context.clip();
      context.drawImage(side.canvas, left, top, g.width * g.zoom, g.height * g.zoom);
      context.restore();
    });
    context.fillStyle = "#000";
    context.fillRect(split - 2, 0, 4, g.tall);
    context.fillStyle = "#fff";
    context.fillRect(split - 1, 0, 2, g.tall);
    $("v-zoom").textContent = `${g.zoom}×`;
    shown.place = { left, top, split, ...g };
  }

  function readout(event) {
    if (!shown?.place) return;
    const { left, top, zoom, ratio } = shown.place;
    const box = canvas.getBoundingClientRect();
    const x = Math.floor(((event.clientX - box.left) * ratio - left) / zoom);
    const y = Math.floor(((event.clientY - box.top) * ratio - top) / zoom);
    const text = (image) => {
      if (!image || x < 0 || y < 0 || x >= image.width || y >= image.height) return null;
      const n = image.width * image.height;
      return Array.from({ length: image.channels }, (_, c) => Number(image.data[c * n + y * image.width + x].toPrecision(4))).join(", ");
    };
    const [a, b] = shown.sides.map((s) => text(s.image));
    if (a === null) return;
    const crop = scene().crop ?? [0, 0];
    const reference = text(shown.reference);
    $("v-readout").textContent = `Column ${x + crop[0]}, row ${y + crop[1]} · A ${a} · B ${b}` + (reference ? ` · reference ${reference}` : "");
  }

  const limited = (zoom) => Math.max(1, Math.min(MOST, zoom));

  function zoomTo(zoom) {
    state.zoom = limited(zoom);
    draw();
  }

  // Zooms so that the image pixel under the pointer stays there.
  function zoomAt(zoom, event) {
    const g = shown?.place;
    if (!g) return;
    const box = canvas.getBoundingClientRect();
    const next = limited(zoom);
    const center = (pointer, start, room, size) => {
      const at = (pointer - start) / (size * g.zoom);
      return Math.min(1, Math.max(0, at + (room / 2 - pointer) / (size * next)));
    };
    state.x = center((event.clientX - box.left) * g.ratio, g.left, g.room, g.width);
    state.y = center((event.clientY - box.top) * g.ratio, g.top, g.tall, g.height);
    zoomTo(next);
    // Near the border the image stops moving; panning goes on from what is seen.
    pan(0, 0);
  }

  function pan(dx, dy) {
    const g = shown?.place;
    if (!g) return;
    const move = (value, delta, size, room) => {
      const half = room / (2 * size * g.zoom);
      return half >= 0.5 ? 0.5 : Math.min(1 - half, Math.max(half, value - delta / (size * g.zoom)));
    };
    state.x = move(state.x, dx * g.ratio, g.width, g.room);
    state.y = move(state.y, dy * g.ratio, g.height, g.tall);
    draw();
  }

  function wipeTo(clientX) {
    const g = shown?.place;
    if (!g) return;
    const at = (clientX - canvas.getBoundingClientRect().left) * g.ratio;
    const share = g.left < 0 ? at / g.room : (at - g.left) / (g.width * g.zoom);
    state.wipe = Math.min(1, Math.max(0, share));
    $("v-wipe").value = 100 * state.wipe;
    draw();
  }

  function setGain(value) {
    const clamped = Math.max(-8, Math.min(8, value));
    if (isMap()) state.gain = clamped; else state.exposure = clamped;
    refresh();
  }

  async function resetGain() {
    const reference = scene().reference ?? level()?.images[rows()[0]];
    state.exposure = reference === undefined ? 0 : suitableExposure(await imageAt(reference));
    state.gain = SENSITIVITY;
    await refresh();
  }

  function swap() {
    [state.a, state.b] = [state.b, state.a];
    refresh();
  }

  // Chooses a scene at the opening level, comparing the first two of these rows.
  async function open(index, labels) {
    state.scene = index;
    const opening = scene().levels.findIndex((l) => l.spp === gallery.spp);
    state.level = Math.max(0, opening);
    [state.a, state.b] = [labels?.[0] ?? state.a, labels?.[1] ?? state.b];
    state.zoom = 0;
    await resetGain();
  }

  // Controls.
  $("v-scene").addEventListener("change", (e) => {
    const spp = level()?.spp;
    state.scene = Number(e.target.value);
    state.level = Math.max(0, scene().levels.findIndex((l) => l.spp === spp));
    state.zoom = 0;
    resetGain();
  });
  for (const [id, key, convert] of [["v-spp", "level", Number], ["v-a", "a", String], ["v-b", "b", String], ["v-view", "view", String]]) {
    $(id).addEventListener("change", (e) => { state[key] = convert(e.target.value); refresh(); });
  }
  $("v-swap").addEventListener("click", swap);
  $("v-gain").addEventListener("input", (e) => setGain(Number(e.target.value)));
  $("v-reset").addEventListener("click", resetGain);
  $("v-wipe").addEventListener("input", (e) => { state.wipe = e.target.value / 100; draw(); });
  $("v-in").addEventListener("click", () => zoomTo((shown?.place?.zoom ?? 1) + 1));
  $("v-out").addEventListener("click", () => zoomTo((shown?.place?.zoom ?? 2) - 1));
  $("v-fit").addEventListener("click", () => { state.zoom = 0; draw(); });

  // Pointer: drag the divider, or the image where it is larger than the stage and the divider is far.
  let drag = null;
  stage.addEventListener("pointerdown", (e) => {
    const g = shown?.place;
    if (!g || e.button !== 0) return;
    const distance = Math.abs((e.clientX - canvas.getBoundingClientRect().left) * g.ratio - g.split);
    const panning = stage.classList.contains("zoomed") && distance > 16 * g.ratio;
    drag = { panning, x: e.clientX, y: e.clientY };
    stage.setPointerCapture(e.pointerId);
    if (!panning) wipeTo(e.clientX);
  });
  stage.addEventListener("pointermove", (e) => {
    readout(e);
    if (!drag) return;
    if (drag.panning) {
      pan(e.clientX - drag.x, e.clientY - drag.y);
      drag.x = e.clientX;
      drag.y = e.clientY;
    } else wipeTo(e.clientX);
  });
  for (const end of ["pointerup", "pointercancel"]) stage.addEventListener(end, () => { drag = null; });
  // The wheel zooms; where it cannot, it scrolls the page. Touchpads send many small steps.
  let turned = 0;
  stage.addEventListener("wheel", (e) => {
    const g = shown?.place;
    if (!g || e.deltaY === 0) return;
    const closer = e.deltaY < 0;
    if (closer ? g.zoom >= MOST : g.zoom <= g.fit) { turned = 0; return; }
    e.preventDefault();
    turned += e.deltaMode === 0 ? e.deltaY : 40 * e.deltaY;
    if (Math.abs(turned) < 40) return;
    turned = 0;
    const step = Math.max(1, Math.round(0.2 * g.zoom));
    zoomAt(closer ? g.zoom + step : Math.max(g.fit, g.zoom - step), e);
  }, { passive: false });
  stage.addEventListener("keydown", (e) => {
    const zoomed = stage.classList.contains("zoomed");
    const step = (dx, dy) => {
      if (zoomed && !e.shiftKey) pan(-40 * dx, -40 * dy);
      else if (dx) { state.wipe = Math.min(1, Math.max(0, state.wipe + 0.02 * dx)); $("v-wipe").value = 100 * state.wipe; draw(); }
    };
    const keys = {
      ArrowLeft: () => step(-1, 0), ArrowRight: () => step(1, 0), ArrowUp: () => step(0, -1), ArrowDown: () => step(0, 1),
      "+": () => zoomTo((shown?.place?.zoom ?? 1) + 1), "-": () => zoomTo((shown?.place?.zoom ?? 2) - 1),
      0: () => { state.zoom = 0; draw(); }, x: swap, e: () => setGain(Number($("v-gain").value) + 0.25), d: () => setGain(Number($("v-gain").value) - 0.25),
    };
    const vertical = e.key === "ArrowUp" || e.key === "ArrowDown";
    if (!keys[e.key] || e.ctrlKey || e.metaKey || e.altKey || (vertical && !zoomed)) return;
    e.preventDefault();
    keys[e.key]();
  });
  new ResizeObserver(draw).observe(stage);

  // Small pictures at the top of the page open the viewer.
  async function thumbnails(button) {
    const index = gallery.scenes.findIndex((s) => s.id === button.dataset.scene);
    const of = gallery.scenes[index];
    const first = of?.levels.find((l) => l.spp === gallery.spp) ?? of?.levels[0];
    if (!first || of.reference === null) { button.hidden = true; return; }
    const exposure = suitableExposure(await imageAt(of.reference));
    for (const small of button.querySelectorAll("canvas")) {
      const image = small.dataset.label === REFERENCE ? of.reference : first.images[small.dataset.label];
      if (image === undefined) { small.parentElement.hidden = true; continue; }
      const painted = paint(await imageAt(image), null, "image", exposure).canvas;
      small.width = painted.width;
      small.height = painted.height;
      small.getContext("2d").drawImage(painted, 0, 0);
    }
    button.addEventListener("click", () => {
      open(index, JSON.parse(button.dataset.rows));
      $("images").scrollIntoView();
      stage.focus({ preventScroll: true });
    });
  }

  const usable = gallery.scenes.findIndex((s) => s.levels.length > 0);
  if (usable < 0) { $("images").hidden = true; return; }
  const card = document.querySelector(`.thumbs[data-scene="${CSS.escape(gallery.scenes[usable].id)}"]`);
  open(usable, card ? JSON.parse(card.dataset.rows) : null);
  for (const button of document.querySelectorAll(".thumbs")) thumbnails(button);
}

if (gallery) startViewer();
