/* test_search.mjs: the field at the top of the manual's pages leads to names and topics
 *
 *     node tests/web/test_search.mjs build/manual
 */
import {existsSync, readFileSync} from "node:fs";

const folder = process.argv[2], on = {}, offered = [];
const field = {value: "", addEventListener: (event, listener) => { on[event] = listener; }};
const list = {appendChild: option => offered.push(option.value)};
const place = {href: ""};
new Function("document", "location", readFileSync(`${folder}/search.js`, "utf8"))({
    getElementById: id => id === "name" ? field : list, createElement: () => ({})
}, place);

const wrong = [];
function leads(event, text, wanted) {
    field.value = text;
    place.href = "";
    on[event]();
    if (!wanted.test(place.href)) wrong.push(`${event} ${text}: ${place.href}`);
}
leads("input", "sl_plan_solve", /^api-plan[.]html#sl_plan_solve$/);
leads("input", "SL_ERR_STALE", /#sl_status$/);
leads("input", "options.pivots", /#sl_options$/);
leads("input", "SL_NO_SIMD", /^api-config/);
leads("input", "sl_plan_sol", /^$/);
leads("change", "Singular", /^do-singular[.]html$/);
leads("change", "no such thing", /^$/);
leads("change", "", /^$/);
for (const name of offered) {
    leads("input", name, /./);
    const [page, id] = place.href.split("#"), path = `${folder}/${page}`;
    if (!existsSync(path) || (id && !readFileSync(path, "utf8").includes(`id="${id}"`))) wrong.push(name);
}
console.log(wrong.length === 0 ? `${offered.length} names and topics` : wrong.join("\n"));
process.exit(wrong.length === 0 && offered.length > 300 ? 0 : 1);
