// Images travel as base64 of deflated byte planes; see the formats in the report's source.
const gallery = JSON.parse(document.getElementById("gallery")?.textContent ?? "null");
const decoded = new Map();

async function inflate(text) {
  if (typeof DecompressionStream === "undefined") {
    throw new Error("This browser cannot unpack the images (no DecompressionStream).");
  }
  const packed = atob(text.trim());
  const bytes = new Uint8Array(packed.length);
  for (let i = 0; i < packed.length; i++) bytes[i] = packed.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function halfToNumber(bits) {
  const sign = bits & 0x8000 ? -1 : 1;
  const exponent = (bits >> 10) & 31;
  const fraction = bits & 1023;
  if (exponent === 0) return sign * fraction * 2 ** -24;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (1024 + fraction) * 2 ** (exponent - 25);
}

// Planar floats: {width, height, channels, data}.
async function unpack(description, text) {
  const { width, height, channels, format, scale } = description;
  const planes = await inflate(text);
  const n = width * height;
  const data = new Float32Array(n * channels);
  if (format === "rgb9e5") {
    for (let p = 0; p < n; p++) {
      const step = 2 ** (planes[p] - 31) * scale;
      const low = planes[4 * n + p];
      for (let c = 0; c < 3; c++) {
        data[c * n + p] = ((planes[(1 + c) * n + p] << 1) | ((low >> c) & 1)) * step;
      }
    }
  } else {
    for (let c = 0; c < channels; c++) {
      for (let p = 0; p < n; p++) {
        data[c * n + p] = halfToNumber((planes[2 * c * n + p] << 8) | planes[(2 * c + 1) * n + p]) * scale;
      }
    }
  }
  return { width, height, channels, data };
}

function imageAt(index) {
  if (!decoded.has(index)) {
    decoded.set(index, unpack(gallery.images[index], document.getElementById(`image-${index}`).textContent));
  }
  return decoded.get(index);
}

const luminance = (r, g, b) => 0.2126 * r + 0.7152 * g + 0.0722 * b;

// sRGB curve as a table over [0, 1].
const srgb = new Uint8Array(4097);
for (let i = 0; i < srgb.length; i++) {
  const v = i / 4096;
  srgb[i] = Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055));
}

function ramp(stops) {
  const table = new Uint8Array(256 * 3);
  const parts = stops.map((s) => [1, 3, 5].map((i) => parseInt(s.slice(i, i + 2), 16)));
  for (let i = 0; i < 256; i++) {
    const x = (i / 255) * (parts.length - 1);
    const k = Math.min(Math.floor(x), parts.length - 2);
    for (let c = 0; c < 3; c++) {
      table[3 * i + c] = Math.round(parts[k][c] + (x - k) * (parts[k + 1][c] - parts[k][c]));
    }
  }
  return table;
}

// Viridis (van der Walt and Smith), and a blue-white-orange ramp for signs.
const MAGNITUDE = ramp(["#440154", "#482475", "#414487", "#355f8d", "#2a788e", "#21918c", "#22a884", "#44bf70", "#7ad151", "#bddf26", "#fde725"]);
const SIGNED = ramp(["#08306b", "#2171b5", "#6baed6", "#c6dbef", "#f7f7f7", "#fdd0a2", "#fd8d3c", "#d94801", "#7f2704"]);

// Exposure that puts the 90th percentile of the luminance at 0.7.
function suitableExposure(image) {
  const n = image.width * image.height;
  const sample = [];
  for (let p = 0; p < n; p += Math.max(1, Math.floor(n / 20000))) {
    const at = (c) => image.data[Math.min(c, image.channels - 1) * n + p];
    const y = luminance(at(0), at(1), at(2));
    if (Number.isFinite(y) && y > 0) sample.push(y);
  }
  if (!sample.length) return 0;
  sample.sort((a, b) => a - b);
  const stops = Math.log2(0.7 / sample[Math.floor(0.9 * (sample.length - 1))]);
  return Math.max(-8, Math.min(8, Math.round(stops * 4) / 4));
}

// A canvas of the image's own size. `view` is image, magnitude, signed or range; `gain` in stops.
function paint(image, reference, view, gain) {
  const { width, height, channels, data } = image;
  const n = width * height;
  const pixels = new ImageData(width, height);
  const out = pixels.data;
  const factor = 2 ** gain;
  const at = (im, c, p) => im.data[Math.min(c, im.channels - 1) * n + p];
  let [low, high] = [Infinity, -Infinity];
  if (view === "range") {
    for (const v of data) if (Number.isFinite(v)) { low = Math.min(low, v); high = Math.max(high, v); }
  }
  for (let p = 0; p < n; p++) {
    const x = [at(image, 0, p), at(image, 1, p), at(image, 2, p)];
    let rgb;
    if (!x.every(Number.isFinite)) rgb = [255, 0, 255];
    else if (view === "image") rgb = x.map((v) => srgb[Math.max(0, Math.min(4096, Math.round(v * factor * 4096)))]);
    else if (view === "range") rgb = pick(MAGNITUDE, high > low ? ((x[0] - low) / (high - low)) * factor : 0);
    else {
      const r = [at(reference, 0, p), at(reference, 1, p), at(reference, 2, p)];
      if (view === "magnitude") {
        const sum = x.reduce((s, v, c) => s + (v - r[c]) ** 2 / (r[c] ** 2 + 0.01), 0);
        rgb = pick(MAGNITUDE, Math.sqrt(sum / 3) * factor);
      } else {
        const y = luminance(...r);
        rgb = pick(SIGNED, 0.5 + (0.5 * (luminance(...x) - y) * factor) / Math.sqrt(y * y + 0.01));
      }
    }
    out[4 * p] = rgb[0];
    out[4 * p + 1] = rgb[1];
    out[4 * p + 2] = rgb[2];
    out[4 * p + 3] = 255;
  }
  const canvas = document.createElement("canvas");
  canvas.width = width;
  canvas.height = height;
  canvas.getContext("2d").putImageData(pixels, 0, 0);
  return { canvas, low, high };
}

function pick(table, v) {
  const i = 3 * Math.max(0, Math.min(255, Math.round(v * 255)));
  return [table[i], table[i + 1], table[i + 2]];
}
