import { useEffect, useRef, useState } from "preact/hooks";
import { type Backend, Refusal, sentence_of } from "./backend";
import { Columns } from "./columns";
import { type Calibrated, type Drive, type Found, type Inspected, type Problem } from "./drive_files";
import { FileTable } from "./file_table";
import { GivenNames } from "./given_names";
import { Previews, Remarks } from "./previews";
import { Result } from "./result";
import { type Field, FieldInput, id_of, kLabels, shown_of, sizes_of, type Statements, truth_fields_of, truth_table_of, wheel_fields_of, wheel_table_of } from "./statements";

const problem_of = (error: unknown): Problem =>
  error instanceof Refusal
    ? { sentence: error.message, remedies: error.remedies }
    : { sentence: sentence_of(error), remedies: [] };

const kLooking = "Looking at the files";

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

/** Fields side by side, and what they state. */
function Fields(props: { fields: Field[]; stated: Statements; state: (name: string, value: Statements[string] | undefined) => void }) {
  return (
    <div class="fields">
      {props.fields.map((field) => (
        <FieldInput key={field.name} field={field} value={props.stated[field.name]} set={(value) => props.state(field.name, value)} />
      ))}
    </div>
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
  const [calibrating, set_calibrating] = useState(false);
  const [result, set_result] = useState<{ found: Calibrated; report: string } | null>(null);
  const [dragged, set_dragged] = useState(false);
  const [renamed, set_renamed] = useState<[string, string][]>([]);
  const names = useRef(new GivenNames()).current;
  const newest_look = useRef(0), newest_calibration = useRef(0);

  /** What was said of other files or statements no longer holds, and what is still being computed of them will not, either. */
  const outdate = () => {
    ++newest_calibration.current;
    set_calibrating(false);
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
      const given = added.map((file) => names.give(file));
      for (const file of given) await backend.put(file);
      set_renamed(given.map((file, i): [string, string] => [added[i]!.name, file.name]).filter(([own, name]) => own !== name));
      set_busy(kLooking);
      set_files((before) => [...new Set([...before, ...given.map((file) => file.name)])]);
      pair(null);
    } catch (error) {
      set_problem(problem_of(error));
      set_busy("");
    }
  };

  const remove = (name: string) => {
    names.forget(name);
    set_files(files.filter((each) => each !== name));
    set_roles(({ [name]: _, ...rest }) => rest);
    set_renamed(renamed.filter(([, given]) => given !== name));
    pair(null);
    outdate();
    if (files.length === 1) set_found(null);
  };

  /** Statements as the calls take them: the robot's file is the first that is one, unless another is chosen. */
  const robot = found?.files.find((file) => file.robot)?.name;
  const statements = { ...(robot ? { robot } : {}), ...stated };
  useEffect(() => {
    const mine = ++newest_look.current;
    if (files.length === 0) {
      set_busy("");
      return;
    }
    set_busy(kLooking);
    // Not at each digit that somebody types.
    const soon = setTimeout(() => {
      backend
        .ask<Found>("inspect", { files, roles, ...statements }, () => {})
        .then((answer) => {
          if (mine !== newest_look.current) return;
          set_found(answer);
          const shown = shown_of(stated, answer);
          if (Object.keys(shown).length < Object.keys(stated).length) set_stated(shown);
        })
        .catch((error) => mine === newest_look.current && set_problem(problem_of(error)))
        .finally(() => mine === newest_look.current && set_busy(""));
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
    const mine = newest_calibration.current;
    set_calibrating(true);
    try {
      const answer = await backend.ask<Calibrated>("calibrate", { drives, ...statements }, () => {});
      const report = answer.report ? await (await backend.file(answer.report)).text() : "";
      if (mine === newest_calibration.current) set_result({ found: answer, report });
    } catch (error) {
      if (mine === newest_calibration.current) set_problem(problem_of(error));
    }
    if (mine === newest_calibration.current) set_calibrating(false);
  };

  const wheel_table = found && wheel_table_of(found);
  const truth_table = found && truth_table_of(found);
  const missing = drives.some((drive) => drive.wheels === "" || drive.truth === "");
  const columns = (name: "wheel_columns" | "truth_columns", title: string, file: Inspected, taken: Inspected["understood"]["wheels"], choices: string[]) => (
    <section aria-label={title}>
      <h3>{title}</h3>
      <p><small>of {file.name}; the other tables of this kind are read in the same way</small></p>
      <Columns name={name} title={title} table={file.table!} taken={taken?.columns ?? null} roles={choices}
        stated={stated[name] as string | undefined} state={(value) => state(name, value)} />
    </section>
  );
  return (
    <>
      <h1>Calibrate from your data</h1>
      <p>
        A table or a bag with the wheels of each drive, and what shows where the robot really was: the recording of a tracker (Motive,
        Vicon, Qualisys, TUM, a table, poses in a bag), or a laser scanner's scans in a bag or a log of CARMEN.{" "}
        <strong>Nothing leaves this computer</strong>: the files are read in this page and sent nowhere.
      </p>
      <label class={dragged ? "drop over" : "drop"} onDragOver={(event) => { event.preventDefault(); set_dragged(true); }}
        onDragLeave={() => set_dragged(false)}
        onDrop={(event) => { event.preventDefault(); set_dragged(false); void add(event.dataTransfer?.files); }}>
        Drop files of wheels and tracker here, or choose them
        <input type="file" multiple onChange={(event) => { const input = event.currentTarget; void add(input.files).then(() => { input.value = ""; }); }} />
      </label>
      {renamed.map(([own, name]) => (
        <p key={name}>
          There is another {own} already, so the new one is called <strong>{name}</strong>. Take away the one that you do not need.
        </p>
      ))}
      <p role="status" aria-busy={busy !== "" || calibrating}>{busy || (calibrating ? "Calibrating" : "")}</p>
      {found && (
        <>
          <section aria-label="Files">
            <h2>What is in them</h2>
            <FileTable files={found.files} remove={remove}
              take_for={(name, role) => { set_roles({ ...roles, [name]: role }); pair(null); look_again(); }} />
            {found.files.map((file) => file.problem && <ProblemNote key={file.name} problem={file.problem} />)}
            <Remarks files={found.files} />
            <Previews files={found.files} drives={drives} />
          </section>
          <form aria-label="Robot and drives" onSubmit={(event) => { event.preventDefault(); void calibrate(); }}>
            <h2>How they are read</h2>
            {wheel_table && columns("wheel_columns", "Columns of the wheels", wheel_table, wheel_table.understood.wheels, found.roles.wheels)}
            {truth_table && columns("truth_columns", "Columns of the ground truth", truth_table, undefined, found.roles.truth)}
            <details>
              <summary>Other guesses, each with a menu to correct it</summary>
              <h3>Wheels</h3>
              <Fields fields={wheel_fields_of(found)} stated={stated} state={state} />
              <h3>Ground truth</h3>
              <Fields fields={truth_fields_of(found)} stated={stated} state={state} />
            </details>
            <h2>The robot</h2>
            <p>
              <small>
                What is empty has to be in a bag, in a recording of this project, or in a TOML or YAML file with the robot's sizes, which can be
                dropped like the others{statements.robot && `; ${statements.robot} is used`}.
              </small>
            </p>
            <Fields fields={sizes_of(found)} stated={stated} state={state} />
            <h2>Drives</h2>
            <DriveTable found={found} drives={drives} pair={(next) => { pair(next); outdate(); }} />
            {missing && <p>A drive needs wheels and ground truth: choose the missing file, or leave the drive out.</p>}
            <button type="submit" disabled={busy !== "" || calibrating || drives.length === 0 || missing} aria-busy={calibrating}>
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
