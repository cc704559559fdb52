import type { Opened, Parameter } from "../live/contract";
import { kSteps, type Progress } from "./progress";

const kEscapes: Record<string, string> = { "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" };
const escaped = (text: string) => text.replace(/[&<>"]/g, (each) => kEscapes[each]!);

const kStyle = `:root{color-scheme:light dark}body{font:16px/1.5 system-ui,sans-serif;max-width:52rem;margin:2rem auto;padding:0 1rem}
h2{margin-top:2rem;font-size:1.2rem}table{border-collapse:collapse}th,td{text-align:left;padding:.2rem 1rem .2rem 0;border-bottom:1px solid #8884;vertical-align:top}td.value{text-align:right}small{color:#888}`;

/** A page of this robot by itself: what each step found, and all parameters. */
export function robot_sheet(opened: Opened, parameters: Parameter[], progress: Progress): string {
  const title = escaped(opened.name || opened.hardware);
  const steps = kSteps.filter((each) => progress.done[each.name]).map(({ name, title: step }) => {
    const { skipped, lines } = progress.done[name]!;
    return `<tr><th scope="row">${step}</th><td>${skipped ? "skipped" : lines.map(escaped).join("<br>")}</td></tr>`;
  });
  const rows = parameters.map(
    ({ name, value, unit, doc }) =>
      `<tr><th scope="row">${escaped(name)}</th><td class="value">${escaped(String(value))}</td><td>${unit === "1" ? "" : escaped(unit)}</td><td><small>${escaped(doc)}</small></td></tr>`,
  );
  return `<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1"><title>${title}</title><style>${kStyle}</style></head>
<body><h1>${title}</h1>
<p>${escaped(opened.hardware)}${opened.simulated ? ", simulated" : ""}, firmware ${escaped(opened.firmware)}; ${new Date().toISOString().slice(0, 10)}</p>
<h2>How it was set up</h2><table>${steps.join("\n")}</table>
<h2>Its parameters</h2><table>${rows.join("\n")}</table>
</body></html>
`;
}
