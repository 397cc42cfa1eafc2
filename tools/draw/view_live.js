/* view_live.js: the part of a live page that solves: heat, distance and a harmonic field follow the source */

/* The rest of the page, view_page.html, draws; its names are used here. The kernel is the npm package,
 * sparse_local.js, which comes before this script. L is the cotangent Laplacian of data.live, M the
 * lumped mass; one analysis serves M + t L and L.
 *   heat      (M + t L) u = 1 at the source
 *   distance  L d = div X, where X is the direction in which u falls (the heat method)
 *   harmonic  L h = 0, with h = 1 at the source and 0 at the other marked vertices
 * Only the field that is shown is computed. The source is the first marked vertex. */

const speed = document.createElement("div"); /* what the page does, later the times of a frame */
speed.id = "speed";
speed.textContent = "preparing ...";
element("counts").after(speed);
await new Promise(resolve => { setTimeout(resolve, 20); });

const given = data.live, corner = given.faces ? decode(given.faces, Uint32Array) : face;
const lengths = decode(given.lengths, Float64Array), faces = corner.length / 3;

/* ---- the faces in their planes: corner 0 at the origin, corner 1 at (base, 0), corner 2 at (along, up) ---- */

const base = new Float64Array(faces), along = new Float64Array(faces), up = new Float64Array(faces);
const weight = new Float64Array(3 * faces), area = new Float64Array(faces); /* half a cotangent at each corner */

/* Kahan's product, as in planar_triangle.c: no difference cancels. */
function areaOf(x, y, z) {
    const [c, b, a] = [x, y, z].sort((p, q) => p - q), rest = c - (a - b);
    return rest > 0 ? 0.25 * Math.sqrt((a + (b + c)) * rest) * Math.sqrt((c + (a - b)) * (a + (b - c))) : 0;
}

for (let f = 0; f < faces; f++) {
    const side = lengths.subarray(3 * f, 3 * f + 3), [far, near, bottom] = side;
    const whole = areaOf(far, near, bottom);
    base[f] = bottom;
    along[f] = bottom > 0 ? 0.5 * (bottom + (near - far) * ((near + far) / bottom)) : 0;
    up[f] = bottom > 0 ? 2 * whole / bottom : 0;
    area[f] = whole * given.share;
    for (let k = 0; k < 3 && whole > 0; k++) {
        const a = side[k], b = side[(k + 1) % 3], c = side[(k + 2) % 3], low = Math.min(b, c), high = Math.max(b, c);
        weight[3 * f + k] = given.share * 0.125 * (((high - a) * (high + a) + low * low) / whole);
    }
}

/* ---- the systems ---- */

const sparse = await load(Uint8Array.from(atob(given.kernel), c => c.charCodeAt(0))).catch(error => {
    speed.textContent = `this browser does not run the kernel: ${error.message}`;
    throw error;
});

function system(t, withMass) { /* the lower triangle, with an entry for each edge of each face */
    const count = n + 3 * faces, rows = new Int32Array(count), columns = new Int32Array(count);
    const entries = new Float64Array(count), diagonal = entries.subarray(0, n);
    for (let v = 0; v < n; v++) rows[v] = columns[v] = v;
    for (let k = 0; k < 3 * faces && withMass; k++) diagonal[corner[k]] += area[Math.floor(k / 3)] / 3;
    for (let v = 0; v < n && withMass; v++) diagonal[v] = diagonal[v] > 0 ? diagonal[v] : 1;
    for (let f = 0; f < faces; f++) {
        for (let k = 0; k < 3; k++) {
            const u = corner[3 * f + (k + 1) % 3], v = corner[3 * f + (k + 2) % 3], at = n + 3 * f + k;
            const w = u === v ? 0 : t * weight[3 * f + k];
            rows[at] = Math.max(u, v);
            columns[at] = Math.min(u, v);
            entries[at] = -w;
            diagonal[u] += w;
            diagonal[v] += w;
        }
    }
    return sparse.fromTriplets(n, rows, columns, entries);
}

const began = performance.now(), M = system(given.time, true), L = system(1, false);
const analysis = sparse.analyze(L), heatFactor = analysis.factor(M);
const poisson = analysis.factor(L, {nullPivots: "skip"});
M.dispose();
L.dispose();
const ready = performance.now() - began, everything = [analysis, heatFactor, poisson];
const one = sparse.float64(1), heap = Object.fromEntries(["u", "b", "x"].map(name => [name, sparse.float64(n)]));
one.view[0] = 1;

/* The connected piece of each vertex, by its smallest vertex. */
const piece = Int32Array.from({length: n}, (_, v) => v);
function rootOf(v) {
    while (piece[v] !== v) v = piece[v] = piece[piece[v]];
    return v;
}
for (let k = 0; k < 3 * faces; k++) {
    const a = rootOf(corner[k]), b = rootOf(corner[k - k % 3 + (k + 1) % 3]);
    piece[Math.max(a, b)] = Math.min(a, b);
}
for (let v = 0; v < n; v++) piece[v] = rootOf(v);

/* ---- fields ---- */

function live(name, scale) {
    const field = {name: `${name} (live)`, value: new Float64Array(n), scale, live: name,
        bounds: {linear: [0, 1], logarithm: [1e-12, 1]},
        get sorted() { return this.value.filter(Number.isFinite).sort(); }};
    fields.push(field);
    element("field").add(new Option(field.name));
    return field;
}
const heat = live("heat", "logarithm"), distance = live("distance", "linear"), harmonic = live("harmonic", "linear");

function computeHeat(source) {
    heatFactor.localSolve([source], one, null, heap.u);
}

function setHeat(source) {
    computeHeat(source);
    heat.value.set(heap.u.view);
    let least = Infinity, most = 0; /* of the heat above 0: no heat is as good as none below 12 decades */
    for (const u of heat.value) {
        if (u > 0 && u < least) least = u;
        if (u > most) most = u;
    }
    heat.bounds = {linear: [Math.min(least, most), most], logarithm: [Math.max(least, 1e-12 * most), most]};
}

/* b = div X; X = - grad u / |grad u| on each face that heat reaches. */
function divergence(b, u) {
    b.fill(0);
    for (let f = 0, k = 0; f < faces; f++, k += 3) {
        const i = corner[k], j = corner[k + 1], l = corner[k + 2], p = base[f], q = along[f], r = up[f];
        const largest = Math.max(Math.abs(u[i]), Math.abs(u[j]), Math.abs(u[l]));
        if (!(largest > 1e-290) || !(p > 0) || !(r > 0)) continue;
        /* the gradient times largest p r, so that nothing is divided but by its length */
        const scale = 1 / largest, gx = (u[j] - u[i]) * scale * r, gy = (u[l] - u[i]) * scale * p - (u[j] - u[i]) * scale * q;
        const length = Math.sqrt(gx * gx + gy * gy);
        if (!(length > 0 && length < Infinity)) continue;
        const x = -gx / length, y = -gy / length;
        const a = weight[k] * ((p - q) * x - r * y), c = weight[k + 1] * (q * x + r * y), e = weight[k + 2] * -p * x;
        b[j] += a - e; /* a from corner 1 to 2, c from 2 to 0, e from 0 to 1 */
        b[l] += c - a;
        b[i] += e - c;
    }
}

function setDistance(source) {
    computeHeat(source);
    divergence(heap.b.view, heap.u.view);
    poisson.solve(heap.b, heap.x);
    const x = heap.x.view, zero = x[source], home = piece[source], to = distance.value;
    let most = 0;
    for (let v = 0; v < n; v++) {
        const d = Math.max(0, x[v] - zero);
        if (piece[v] === home) {
            to[v] = d;
            if (d > most) most = d;
        } else {
            to[v] = NaN;
        }
    }
    distance.bounds = {linear: [0, most], logarithm: [1e-3 * most, most]};
}

let source = data.marked[0], pinned = source;
setDistance(source);
if (data.marked.length < 2) { /* the harmonic field is 0 at the farthest vertex */
    let farthest = source;
    for (let v = 0; v < n; v++) if (distance.value[v] > distance.value[farthest]) farthest = v;
    if (farthest !== source) data.marked.push(farthest);
}
const held = data.marked.slice(1), pins = poisson.constraints([...held, source]), nothing = poisson.plan([], null);
const levels = [...held.map(() => 0), 1];

function setHarmonic(to) {
    if (to !== pinned && !held.includes(to)) {
        pins.release([held.length]).add([to]);
        pinned = to;
    }
    pins.solve(null, levels, {x: heap.x, plan: nothing});
    harmonic.value.set(heap.x.view);
    harmonic.bounds = {linear: [0, 1], logarithm: [1e-3, 1]};
}

/* ---- the source moves ---- */

const set = {heat: setHeat, distance: setDistance, harmonic: setHarmonic}, times = [];
/* Computes and shows the field that is selected; milliseconds of the two. */
function update(to) {
    picked = [...new Set(picked.map(v => v === source ? to : v))];
    source = data.marked[0] = to;
    const field = fields[element("field").selectedIndex], start = performance.now();
    if (field?.live) set[field.live](source);
    const solved = performance.now();
    show();
    times.push([solved - start, performance.now() - solved]);
    if (times.length > 1000) times.shift();
    speed.textContent = field?.live ? `${(solved - start).toFixed(1)} ms to solve, ` +
        `${(performance.now() - solved).toFixed(1)} ms to color and draw` : "";
    return times.at(-1);
}

/* The vertices in front, one for each pixel of the window: the last corners of the faces there. */
const idProgram = program(project + `flat out int id; void main() { gl_Position = project(); id = gl_VertexID + 1; }`,
`flat in int id; out vec4 pixel; void main() { pixel = vec4(id & 255, id >> 8 & 255, id >> 16 & 255, 255) / 255.0; }`);
let front = null;
function drawFront() {
    const {width, height} = canvas, texture = gl.createTexture(), depth = gl.createRenderbuffer(), target = gl.createFramebuffer();
    const colors = gl.getParameter(gl.TEXTURE_BINDING_2D);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, width, height, 0, gl.RGBA, gl.UNSIGNED_BYTE, null);
    gl.bindTexture(gl.TEXTURE_2D, colors);
    gl.bindRenderbuffer(gl.RENDERBUFFER, depth);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, width, height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depth);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    use(idProgram);
    attribute(0, positions, 3);
    gl.disableVertexAttribArray(1);
    gl.disableVertexAttribArray(2);
    gl.drawElements(gl.TRIANGLES, face.length, gl.UNSIGNED_INT, 0);
    const ids = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, ids);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.deleteFramebuffer(target);
    gl.deleteRenderbuffer(depth);
    gl.deleteTexture(texture);
    gl.clearColor(1, 1, 1, 1);
    return {ids, width, height};
}

function vertexAt(clientX, clientY) {
    const box = canvas.getBoundingClientRect();
    const x = Math.floor((clientX - box.left) / box.width * front.width);
    const y = Math.floor((1 - (clientY - box.top) / box.height) * front.height);
    if (x < 0 || y < 0 || x >= front.width || y >= front.height) return -1;
    const at = 4 * (y * front.width + x);
    return (front.ids[at] | front.ids[at + 1] << 8 | front.ids[at + 2] << 16) - 1;
}

/* Where a vertex is in the window. */
function place(v) {
    const box = canvas.getBoundingClientRect(), [sx, sy] = scales();
    const at = row => [0, 1, 2].reduce((sum, k) => sum + turn[3 * row + k] * (position[3 * v + k] - center[k]), 0);
    return [box.left + box.width * (1 + sx * at(0) + shift[0]) / 2, box.top + box.height * (1 - sy * at(1) - shift[1]) / 2];
}

/* A pointer that goes down on the dot of the source drags it; elsewhere the page turns. */
let wanted = -1;
function frame() {
    if (wanted >= 0 && wanted !== source) update(wanted);
    if (front) requestAnimationFrame(frame);
}
canvas.addEventListener("pointerdown", e => {
    const [x, y] = place(source);
    if (e.shiftKey || Math.hypot(e.clientX - x, e.clientY - y) > (e.pointerType === "touch" ? 30 : 12)) return;
    e.stopImmediatePropagation();
    canvas.setPointerCapture(e.pointerId);
    front = drawFront();
    wanted = source;
    requestAnimationFrame(frame);
}, true);
canvas.addEventListener("pointermove", e => {
    if (!front) return;
    e.stopImmediatePropagation();
    const v = vertexAt(e.clientX, e.clientY);
    if (v >= 0) wanted = v;
}, true);
canvas.addEventListener("pointerup", e => {
    if (!front) return;
    e.stopImmediatePropagation();
    if (wanted >= 0 && wanted !== source) update(wanted);
    front = null;
    wanted = -1;
}, true);
element("field").addEventListener("change", () => update(source));
document.querySelector(".hint").append(" \u00b7 drag the first dot: move the source");

for (const id of ["field", "scales", "bar", "ends"]) element(id).hidden = false;
element("field").selectedIndex = fields.indexOf(heat);
update(source);

/* For tests, and for the console. */
globalThis.live = {fields, times, ready, update, place, source: () => source, bytes: () => sparse.bytes, keep: everything};
