import { type Body, axis_of, bag_of, type Inspected, is_log, type WheelsFound } from "./drive_files";

const kRoles = [
  ["wheels", "wheels"],
  ["truth", "ground truth"],
  ["both", "wheels and ground truth"],
  ["none", "not used"],
] as const;
const role_of = (file: Inspected) => (file.wheels && file.truth ? "both" : file.wheels ? "wheels" : file.truth ? "truth" : "none");

/** A line of the table: what was taken, and how it lies in time. */
interface Line {
  taken: string;
  unit: string;
  up: string;
  clock: string;
  samples: number;
  duration_s: number;
  rate_hz: number;
  longest_gap_s: number;
  lost: string;
}

const kClocks = { file: "", stamp: "stamps of the messages", receipt: "the recorder's" };

function line_of_wheels(wheels: WheelsFound, file: Inspected): Line {
  const { columns, joints } = wheels;
  const named = columns.left.length > 0 ? [columns.left.join(" + "), columns.right.join(" + ")] : [joints.left, joints.right];
  const source = bag_of(file)?.wheel_sources.find((each) => each.taken)?.name ?? "recorded by this robot";
  return {
    ...wheels,
    taken: named[0] ? `left ${named[0]}, right ${named[1]}` : wheels.odometry || source,
    unit: columns.values || wheels.unit,
    up: "",
    clock: columns.time || kClocks[wheels.clock],
    lost: "",
  };
}

function line_of_truth(body: Body): Line {
  return {
    ...body,
    taken: [body.name || body.id, body.format].filter((each) => each !== "").join(", "),
    unit: body.length_unit || "m, as none is stated",
    up: axis_of(body.up_by_positions) || "not clear",
    clock: body.start_time ? `the tracker's, from ${body.start_time.replace("T", " ")}` : "the tracker's",
    rate_hz: body.median_period_s > 0 ? 1 / body.median_period_s : 0,
    lost: String(body.lost),
  };
}

const millimetres = (metres: number | null) => (metres === null ? "" : `${Number((1000 * metres).toFixed(2))} mm`);

/** What a file is that has no line of its own. */
function in_words(file: Inspected): string {
  if (is_log(file) && file.truth) return "odometry and scans of a laser scanner";
  if (file.scans && file.truth) return "scans of a laser scanner";
  const found = file.inspection;
  if (found?.kind === "end poses") return `end errors of ${found.runs} runs, which this page does not calibrate`;
  if (file.robot && found?.kind === "robot")
    return [
      ["wheel diameter", millimetres(found.wheel_diameter_m)],
      ["wheelbase", millimetres(found.wheelbase_m)],
      ["counts per turn", found.counts_per_turn === null ? "" : String(found.counts_per_turn)],
    ]
      .filter(([, value]) => value !== "")
      .map(([name, value]) => `${name} ${value}`)
      .join(", ");
  return file.problem ? "could not be read, see below" : "nothing that this page can use";
}

function Values({ line }: { line: Line }) {
  return (
    <>
      <td>{line.taken}</td>
      <td>{line.unit}</td>
      <td>{line.up}</td>
      <td>{line.clock}</td>
      <td class="number">{line.samples}</td>
      <td class="number">{line.duration_s.toFixed(1)}</td>
      <td class="number">{line.rate_hz.toPrecision(3)}</td>
      <td class="number">{line.longest_gap_s.toFixed(2)}</td>
      <td class="number">{line.lost}</td>
    </>
  );
}

/** What was understood of each file. A file that is both wheels and ground truth has two lines. */
export function FileTable(props: { files: Inspected[]; take_for: (name: string, role: string) => void; remove: (name: string) => void }) {
  const lines_of = (file: Inspected) => {
    const { wheels, truth } = file.understood;
    return [...(wheels ? [line_of_wheels(wheels, file)] : []), ...(truth ? [line_of_truth(truth)] : [])];
  };
  return (
    <div class="wide" tabIndex={0} role="group" aria-label="What was understood">
      <table class="files">
        <thead>
          <tr>
            {["File", "Taken from", "Unit", "Up", "Clock"].map((title) => (
              <th scope="col" key={title}>{title}</th>
            ))}
            {["Samples", "Lasts, s", "Hz", "Longest gap, s", "Lost"].map((title) => (
              <th scope="col" class="number" key={title}>{title}</th>
            ))}
          </tr>
        </thead>
        <tbody>
          {props.files.map((file) => {
            const lines = lines_of(file);
            const rest = in_words(file);
            const words = lines.length === 0 || (file.scans && file.truth);
            const rows = [...lines.map((line) => <Values line={line} />), ...(words ? [<td colSpan={9}>{rest}</td>] : [])];
            return rows.map((row, i) => (
              <tr key={`${file.name} ${i}`} class={i === 0 ? "file" : undefined}>
                {i === 0 && (
                  <th scope="row" rowSpan={rows.length}>
                    {file.name}
                    <div class="controls">
                      {file.robot ? (
                        <small>the robot</small>
                      ) : (
                        <select aria-label={`${file.name} is`} value={role_of(file)} onChange={(event) => props.take_for(file.name, event.currentTarget.value)}>
                          {kRoles.map(([role, name]) => (
                            <option value={role} key={role}>{name}</option>
                          ))}
                        </select>
                      )}
                      <button type="button" class="outline secondary" aria-label={`Take ${file.name} away`} onClick={() => props.remove(file.name)}>
                        ×
                      </button>
                    </div>
                  </th>
                )}
                {row}
              </tr>
            ));
          })}
        </tbody>
      </table>
    </div>
  );
}
