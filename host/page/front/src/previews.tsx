import { useState } from "preact/hooks";
import type { Drive, Inspected } from "./drive_files";
import { Plot } from "./plot";

const remarks_of = (file: Inspected): string[] => {
  const { wheels, truth } = file.understood;
  return [...(wheels?.remarks ?? []), ...(truth?.remarks ?? []), ...(file.inspection?.kind === "bag" ? file.inspection.warnings : [])];
};

/** Each remark once, with the files that it is about. */
export function Remarks({ files }: { files: Inspected[] }) {
  const names = new Map<string, string[]>();
  for (const file of files) for (const remark of remarks_of(file)) names.set(remark, [...(names.get(remark) ?? []), file.name]);
  if (names.size === 0) return null;
  return (
    <ul class="remarks">
      {[...names].map(([remark, of]) => (
        <li key={remark}>
          <small>
            <strong>{of[0]}{of.length > 1 && ` and ${of.length - 1} more`}</strong>: {remark}
          </small>
        </li>
      ))}
    </ul>
  );
}

/** The wheels and the ground truth of one drive beside each other, so that clocks, gaps and units can be compared. */
export function Previews({ files, drives }: { files: Inspected[]; drives: Drive[] }) {
  const [chosen, choose] = useState("");
  const lone = files.filter(({ name }) => !drives.some((drive) => drive.wheels === name || drive.truth === name));
  const offered = [
    ...drives.map((drive, i) => ({ title: `drive ${i + 1}: ${[...new Set([drive.wheels, drive.truth])].filter((each) => each).join(", ")}`, ...drive })),
    ...lone.map(({ name }) => ({ title: name, wheels: name, truth: name })),
  ];
  const preview_of = (name: string) => files.find((file) => file.name === name)?.preview;
  const drawn = offered.filter((each) => preview_of(each.wheels)?.wheels || preview_of(each.truth)?.truth);
  const shown = drawn.find((each) => each.title === chosen) ?? drawn[0];
  if (!shown) return null;
  const wheels = preview_of(shown.wheels)?.wheels;
  const truth = preview_of(shown.truth)?.truth;
  return (
    <section aria-label="Plots">
      <label class="plotted">
        Plot of
        <select value={shown.title} onChange={(event) => choose(event.currentTarget.value)}>
          {drawn.map(({ title }) => (
            <option key={title}>{title}</option>
          ))}
        </select>
      </label>
      <div class="previews">
        {wheels && (
          <Plot title={`Travel of the wheels in ${shown.wheels}`} unit={wheels.unit} times={wheels.t_s}
            series={[{ name: "left", colour: "--odometry", values: wheels.left }, { name: "right", colour: "--truth", values: wheels.right }]} />
        )}
        {truth && (
          <Plot title={`Positions in ${shown.truth}`} unit="m" times={truth.t_s}
            series={[{ name: "x", colour: "--odometry", values: truth.x_m }, { name: "y", colour: "--truth", values: truth.y_m }, { name: "z", colour: "--third", values: truth.z_m }]} />
        )}
      </div>
    </section>
  );
}
