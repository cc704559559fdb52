import { useEffect, useRef, useState } from "preact/hooks";
import { type Backend, Refusal, sentence_of } from "./backend";
import { Columns } from "./columns";
import { bag_of, bodies_of, type Calibrated, type Drive, type Found, type Inspected, type Problem, wheels_of } from "./drive_files";
import { FactorTable } from "./factors";
import { Plot } from "./plot";
import { save } from "./saving";
import { FieldInput, fields_of, id_of, kLabels, kSizes, type Statements } from "./statements";

const problem_of = (error: unknown): Problem =>
  error instanceof Refusal
    ? { sentence: error.message, remedies: error.remedies }
    : { sentence: sentence_of(error), remedies: [] };

const kLooking = "Looking at the files";

const kRoles = [
  ["wheels", "wheels"],
  ["truth", "ground truth"],
  ["both", "wheels and ground truth"],
  ["none", "not used"],
] as const;
const role_of = (file: Inspected) => (file.wheels && file.truth ? "both" : file.wheels ? "wheels" : file.truth ? "truth" : "none");

const axis_of = (up: number[] | null | undefined) => {
  const at = up?.findIndex((part) => Math.abs(part) > 0.99) ?? -1;
  return at < 0 ? "" : `, ${"xyz"[at]} is up or down`;
};

/** What was understood of a file, in a line. */
function understood(file: Inspected): string {
  if (file.robot) return "sizes of the robot";
  const parts: string[] = [];
  const wheels = wheels_of(file);
  if (wheels)
    parts.push(`${wheels.samples} rows in ${wheels.duration_s.toFixed(1)} s; ${wheels.columns.left.join(", ")} left, ${wheels.columns.right.join(", ")} right, in ${wheels.columns.values}; longest gap ${wheels.longest_gap_s.toFixed(2)} s`);
  for (const body of bodies_of(file))
    parts.push(`${body.format}${body.name ? `, ${body.name}` : ""}: ${body.samples} poses in ${body.duration_s.toFixed(1)} s, ${body.lost} lost, longest gap ${body.longest_gap_s.toFixed(2)} s${axis_of(body.up_by_positions)}${body.length_unit ? `, in ${body.length_unit}` : ""}`);
  const bag = bag_of(file);
  if (bag) {
    const taken = bag.wheel_sources.find((each) => each.taken);
    parts.push(`bag of ${bag.topics.length} topics; wheels: ${taken?.name ?? "not clear"}; poses: ${bag.poses.map((each) => each.topic).join(", ") || "none"}`);
  }
  return parts.join("; ");
}

function remarks_of(file: Inspected): string[] {
  return [...(wheels_of(file)?.remarks ?? []), ...bodies_of(file).flatMap((body) => body.remarks), ...(bag_of(file)?.warnings ?? [])];
}

function Preview({ file }: { file: Inspected }) {
  const { wheels, truth } = file.preview;
  return (
    <div class="previews">
      {wheels && (
        <Plot title={`Travel of the wheels in ${file.name}`} unit={wheels.unit} times={wheels.t_s}
          series={[{ name: "left", colour: "--odometry", values: wheels.left }, { name: "right", colour: "--truth", values: wheels.right }]} />
      )}
      {truth && (
        <Plot title={`Positions in ${file.name}`} unit="m" times={truth.t_s}
          series={[{ name: "x", colour: "--odometry", values: truth.x_m }, { name: "y", colour: "--truth", values: truth.y_m }, { name: "z", colour: "--third", values: truth.z_m }]} />
      )}
    </div>
  );
}

/** Opens what hides a field, and goes there. */
function go_to(name: string) {
  const field = document.getElementById(id_of(name));
  field?.closest("details")?.setAttribute("open", "");
  field?.focus();
}

function ProblemNote({ problem }: { problem: Problem }) {
  const reachable = problem.remedies.filter((name) => document.getElementById(id_of(name)));
  return (
    <div role="alert" class="problem">
      <p>{problem.sentence}</p>
      {reachable.length > 0 && (
        <p>
          What may help:{" "}
          {reachable.map((name) => (
            <button type="button" class="outline" key={name} onClick={() => go_to(name)}>
              {kLabels[name] ?? name}
            </button>
          ))}
        </p>
      )}
    </div>
  );
}

function DriveTable(props: { found: Found; drives: Drive[]; pair: (drives: Drive[]) => void }) {
  const names = (kind: "wheels" | "truth") => props.found.files.filter((file) => file[kind]).map((file) => file.name);
  const menu = (drive: Drive, at: number, kind: "wheels" | "truth", label: string) => (
    <select aria-label={`${label} of drive ${at + 1}`} value={drive[kind]} aria-invalid={drive[kind] === "" ? "true" : undefined}
      onChange={(event) => props.pair(props.drives.map((each, i) => (i === at ? { ...each, [kind]: event.currentTarget.value } : each)))}>
      <option value="">none</option>
      {names(kind).map((name) => (
        <option key={name}>{name}</option>
      ))}
    </select>
  );
  return (
    <div class="wide" tabIndex={0} role="group" aria-label="Drives">
      <table class="drives">
        <thead>
          <tr>
            <th scope="col">Drive</th>
            <th scope="col">Wheels</th>
            <th scope="col">Ground truth</th>
            <th scope="col">Leave out</th>
          </tr>
        </thead>
        <tbody>
          {props.drives.map((drive, i) => (
            <tr key={i}>
              <th scope="row">{i + 1}</th>
              <td>{menu(drive, i, "wheels", "Wheels")}</td>
              <td>{menu(drive, i, "truth", "Ground truth")}</td>
              <td>
                <button type="button" class="outline secondary" aria-label={`Leave out drive ${i + 1}`}
                  onClick={() => props.pair(props.drives.filter((_, other) => other !== i))}>
                  ×
                </button>
              </td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

function Result(props: { found: Calibrated; report: string; file: (path: string) => Promise<Blob> }) {
  const { found } = props;
  const download = async (path: string) => save(path.split("/").at(-1)!, await props.file(path));
  return (
    <section aria-label="Result">
      <h2>Result</h2>
      <p class={found.advises_against ? "against" : ""}>{found.verdict}</p>
      <FactorTable
        columns={[
          { title: "Loaded", factors: found.calibration.carried },
          { title: "Found", factors: found.calibration },
          { title: "±", factors: found.calibration.standard_errors },
          { title: "± another day", factors: found.calibration.standard_errors_another_day },
        ]}
      />
      {found.not_in_ros2 && <p>{found.ros2 ? "" : "There is no file for diff_drive_controller: "}{found.not_in_ros2}</p>}
      <div class="row">
        {found.ros2 && (
          <button type="button" onClick={() => void download(found.ros2!)}>
            Save for diff_drive_controller
          </button>
        )}
        <button type="button" class="secondary" onClick={() => void download(found.toml)}>
          Save as TOML
        </button>
        <button type="button" class="secondary" onClick={() => void download(found.report)}>
          Save the report
        </button>
      </div>
      <details>
        <summary>What was found in each drive</summary>
        {found.drives.map((drive) => (
          <div key={drive.name}>
            <p>
              <strong>{drive.name}</strong>: {drive.summary}
            </p>
            {drive.remarks.length > 0 && (
              <ul>
                {drive.remarks.map((remark) => (
                  <li key={remark}>{remark}</li>
                ))}
              </ul>
            )}
          </div>
        ))}
      </details>
      {props.report && <iframe srcdoc={props.report} title="Report" sandbox="allow-scripts" />}
    </section>
  );
}

/** Files of wheels and ground truth become factors. */
export function DataPage({ backend }: { backend: Backend }) {
  const [files, set_files] = useState<string[]>([]);
  const [roles, set_roles] = useState<Record<string, string>>({});
  const [stated, set_stated] = useState<Statements>({});
  const [paired, pair] = useState<Drive[] | null>(null);
  const [found, set_found] = useState<Found | null>(null);
  const [problem, set_problem] = useState<Problem | null>(null);
  const [busy, set_busy] = useState("");
  const [result, set_result] = useState<{ found: Calibrated; report: string } | null>(null);
  const [dragged, set_dragged] = useState(false);
  const newest = useRef(0);

  /** What was said of other files or statements no longer holds. */
  const outdate = () => {
    set_problem(null);
    set_result(null);
  };
  const look_again = () => {
    outdate();
    set_busy(kLooking);
  };

  const add = async (list: FileList | null | undefined) => {
    const added = [...(list ?? [])];
    if (added.length === 0) return;
    set_busy("Reading the files");
    outdate();
    try {
      for (const file of added) await backend.put(file);
      set_busy(kLooking);
      set_files((before) => [...new Set([...before, ...added.map((file) => file.name)])]);
      pair(null);
    } catch (error) {
      set_problem(problem_of(error));
      set_busy("");
    }
  };

  const robot = found?.files.find((file) => file.robot)?.name;
  useEffect(() => {
    if (files.length === 0) {
      ++newest.current;
      set_busy("");
      return;
    }
    const mine = ++newest.current;
    set_busy(kLooking);
    const question = { files, roles, ...stated, ...(robot && !("robot" in stated) ? { robot } : {}) };
    // Not at each digit that somebody types.
    const soon = setTimeout(() => {
      backend
        .ask<Found>("inspect", question)
        .then((answer) => mine === newest.current && set_found(answer))
        .catch((error) => mine === newest.current && set_problem(problem_of(error)))
        .finally(() => mine === newest.current && set_busy(""));
    }, 250);
    return () => clearTimeout(soon);
  }, [files, roles, stated, robot]);

  const state = (name: string, value: Statements[string] | undefined) => {
    look_again();
    set_stated(({ [name]: _, ...rest }) => (value === undefined ? rest : { ...rest, [name]: value }));
  };

  const drives = paired ?? found?.drives ?? [];
  const calibrate = async () => {
    outdate();
    set_busy("Calibrating");
    try {
      const answer = await backend.ask<Calibrated>("calibrate", { drives, ...stated, ...(robot ? { robot } : {}) });
      set_result({ found: answer, report: await (await backend.file(answer.report)).text() });
    } catch (error) {
      set_problem(problem_of(error));
    }
    set_busy("");
  };

  const wheel_table = found?.files.find((file) => file.wheels && file.table);
  const truth_table = found?.files.find((file) => file.truth && !file.wheels && file.table);
  const missing = drives.some((drive) => drive.wheels === "" || drive.truth === "");
  return (
    <>
      <h1>Calibrate from your data</h1>
      <p>
        A table or a bag with the wheels of each drive, and the recording of a tracker: Motive, Vicon, Qualisys, TUM, a table, or poses
        in a bag. <strong>Nothing leaves this computer</strong>: the files are read in this page and sent nowhere.
      </p>
      <label class={dragged ? "drop over" : "drop"} onDragOver={(event) => { event.preventDefault(); set_dragged(true); }}
        onDragLeave={() => set_dragged(false)}
        onDrop={(event) => { event.preventDefault(); set_dragged(false); void add(event.dataTransfer?.files); }}>
        Drop files of wheels and tracker here, or choose them
        <input type="file" multiple onChange={(event) => { const input = event.currentTarget; void add(input.files).then(() => { input.value = ""; }); }} />
      </label>
      <p role="status" aria-busy={busy !== ""}>{busy}</p>
      {found && (
        <>
          <section aria-label="Files">
            <h2>What is in them</h2>
            {found.files.map((file) => (
              <article key={file.name} class="file">
                <div class="head">
                  <strong>{file.name}</strong>
                  {!file.robot && (
                    <select aria-label={`${file.name} is`} value={role_of(file)}
                      onChange={(event) => { set_roles({ ...roles, [file.name]: event.currentTarget.value }); pair(null); look_again(); }}>
                      {kRoles.map(([role, words]) => (
                        <option value={role} key={role}>{words}</option>
                      ))}
                    </select>
                  )}
                  <button type="button" class="outline secondary" aria-label={`Take ${file.name} away`}
                    onClick={() => { set_files(files.filter((name) => name !== file.name)); pair(null); outdate(); if (files.length === 1) set_found(null); }}>
                    ×
                  </button>
                </div>
                <p>{understood(file)}</p>
                {remarks_of(file).map((remark) => <p key={remark}><small>{remark}</small></p>)}
                {file.problem && <ProblemNote problem={file.problem} />}
                {(file.preview.wheels || file.preview.truth) && (
                  <details>
                    <summary>Plot</summary>
                    <Preview file={file} />
                  </details>
                )}
              </article>
            ))}
          </section>
          {wheel_table?.table && (
            <section aria-label="Columns of the wheels">
              <h2>Columns of the wheels</h2>
              <p><small>of {wheel_table.name}; the other tables of wheels are read in the same way</small></p>
              <Columns name="wheel_columns" title="Columns of the wheels" table={wheel_table.table} taken={wheels_of(wheel_table)?.columns ?? null}
                roles={found.roles.wheels} stated={stated.wheel_columns as string | undefined}
                state={(columns) => state("wheel_columns", columns)} />
            </section>
          )}
          {truth_table?.table && (
            <section aria-label="Columns of the ground truth">
              <h2>Columns of the ground truth</h2>
              <p><small>of {truth_table.name}; the other tables of ground truth are read in the same way</small></p>
              <Columns name="truth_columns" title="Columns of the ground truth" table={truth_table.table} taken={null}
                roles={found.roles.truth} stated={stated.truth_columns as string | undefined}
                state={(columns) => state("truth_columns", columns)} />
            </section>
          )}
          <form aria-label="Robot and drives" onSubmit={(event) => { event.preventDefault(); void calibrate(); }}>
            <h2>The robot</h2>
            <p><small>A TOML or YAML file with the robot's sizes can be dropped instead{robot && `; ${robot} is used`}.</small></p>
            <div class="fields">
              {kSizes.map((field) => (
                <FieldInput key={field.name} field={field} value={stated[field.name]} set={(value) => state(field.name, value)} />
              ))}
            </div>
            <details>
              <summary>How to read the files, where it was not recognised</summary>
              <div class="fields">
                {fields_of(found).map((field) => (
                  <FieldInput key={field.name} field={field} value={stated[field.name]} set={(value) => state(field.name, value)} />
                ))}
              </div>
            </details>
            <h2>Drives</h2>
            <DriveTable found={found} drives={drives} pair={(next) => { pair(next); outdate(); }} />
            {missing && <p>A drive needs wheels and ground truth: choose the missing file, or leave the drive out.</p>}
            <button type="submit" disabled={busy !== "" || drives.length === 0 || missing} aria-busy={busy === "Calibrating"}>
              Calibrate
            </button>
          </form>
        </>
      )}
      {problem && <ProblemNote problem={problem} />}
      {result && <Result found={result.found} report={result.report} file={(path) => backend.file(path)} />}
    </>
  );
}
