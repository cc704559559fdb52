import { useState } from "preact/hooks";
import { axis_of, bag_of, bodies_of, type Found, is_log, type Table, unique } from "./drive_files";

/** What a person states beside the files; the names are those of host/page/calls/statements.hpp. What is missing is recognised. */
export type Statements = Record<string, string | number | boolean | string[]>;

/** What each is called in the page. */
export const kLabels: Record<string, string> = {
  wheel_diameter: "Wheel diameter",
  wheelbase: "Wheelbase",
  counts_per_turn: "Counts per turn",
  wheels_topic: "Wheels in the bag",
  wheels_unit: "Their unit",
  joints: "Joints of the wheels",
  truth_topic: "Ground truth in the bag",
  truth_frames: "Its frames, parent to child",
  scan_topic: "Laser scanner in the bag",
  robot: "File with the robot's sizes",
  controller: "Controller in that file",
  body: "The robot among the tracked bodies",
  per_interval: "Each row is the travel since the row before",
  counter_range: "Counters start again after",
  swap_wheels: "Left and right are exchanged in the files",
  reverse_wheels: "Both encoders count backward when the robot drives forward",
  drives_backward: "The robot did drive backward",
  up: "Axis of the tracker that points up",
  truth_unit: "Unit of its positions",
  truth_mirrored: "Its positions are a mirror image",
  wheel_columns: "Columns of the wheels",
  truth_columns: "Columns of the ground truth",
};

interface Menu {
  kind: "menu";
  /** The words beside what they stand for. */
  choices: [string, string | string[]][];
}
interface NumberField {
  kind: "number";
  unit: string;
  /** Of what is entered to SI. */
  scale: number;
}
interface Flag {
  kind: "flag";
}
/** `recognised`: what is taken while nothing is stated, as far as that is known before calibrating. */
export type Field = { name: string; hint?: string; recognised?: string } & (Menu | NumberField | Flag);

const words = (all: string[]): [string, string][] => all.map((each) => [each, each]);

/** What the robot is made of; a log of odometry and scans has use for the wheelbase alone. */
export function sizes_of(found: Found): Field[] {
  const sizes: Field[] = [
    { name: "wheelbase", hint: "between the wheels, as the robot's program takes it", kind: "number", unit: "mm", scale: 0.001 },
    { name: "wheel_diameter", hint: "as the robot's program takes it", kind: "number", unit: "mm", scale: 0.001 },
    { name: "counts_per_turn", hint: "of the wheel, for wheels in counts", kind: "number", unit: "", scale: 1 },
  ];
  const robots = found.files.filter((file) => file.robot);
  const controllers = unique(robots.flatMap((file) => file.controllers));
  const logs = found.files.filter((file) => file.wheels);
  const menus: (Field | false)[] = [
    robots.length > 1 && { name: "robot", kind: "menu", choices: words(robots.map((file) => file.name)), recognised: robots[0]?.name },
    controllers.length > 0 && { name: "controller", kind: "menu", choices: words(controllers) },
  ];
  const only_logs = logs.length > 0 && logs.every(is_log);
  return [...sizes.slice(0, only_logs ? 1 : undefined), ...menus.filter((each) => each !== false)];
}

const joined = (all: string[]) => unique(all).join(" or ");

/** The menus about wheels that these files have a use for. */
export function wheel_fields_of(found: Found): Field[] {
  const files = found.files.filter((file) => file.wheels);
  const recorded = files.filter((file) => !is_log(file));
  const bags = files.map(bag_of).filter((each) => each !== null);
  const taken = files.map((file) => file.understood.wheels).filter((each) => each !== undefined);
  const sources = unique(bags.flatMap((bag) => bag.wheel_sources.map((each) => each.name)));
  const joints = unique(bags.flatMap((bag) => bag.joints));
  const pairs = joints.flatMap((left) => joints.filter((right) => right !== left).map((right): [string, string[]] => [`${left} left, ${right} right`, [left, right]]));
  const fields: (Field | false)[] = [
    sources.length > 1 && {
      name: "wheels_topic", kind: "menu", choices: words(sources),
      recognised: joined(bags.flatMap((bag) => bag.wheel_sources.filter((each) => each.taken).map((each) => each.name))),
    },
    bags.some((bag) => bag.wheel_sources.some((each) => each.unit === null)) && { name: "wheels_unit", kind: "menu", choices: words(found.units.wheels) },
    pairs.length > 0 && pairs.length <= 90 && {
      name: "joints", kind: "menu", choices: pairs,
      recognised: joined(taken.map(({ joints }) => (joints.left ? `${joints.left} left, ${joints.right} right` : ""))),
    },
    recorded.some((file) => file.table) && { name: "per_interval", kind: "flag" },
    files.length > 0 && { name: "swap_wheels", kind: "flag" },
    files.length > 0 && { name: "reverse_wheels", kind: "flag" },
    found.files.some((file) => file.truth && !file.scans) && { name: "drives_backward", kind: "flag" },
    recorded.length > 0 && { name: "counter_range", hint: "as 65536; found from the data if it is empty", kind: "number", unit: "counts", scale: 1 },
  ];
  return fields.filter((each) => each !== false);
}

const kScans = /\/LaserScan$/;

/** The menus about ground truth that these files have a use for. */
export function truth_fields_of(found: Found): Field[] {
  const files = found.files.filter((file) => file.truth);
  const tracked = files.filter((file) => !file.scans);
  const bags = files.map(bag_of).filter((each) => each !== null);
  const with_scans = bags.some((bag) => bag.topics.some((topic) => kScans.test(topic.type)));
  const taken = tracked.map((file) => file.understood.truth).filter((each) => each !== undefined);
  const bodies = unique(tracked.flatMap((file) => bodies_of(file).map((body) => body.name || body.id)));
  const topics = unique(bags.flatMap((bag) => bag.poses.map((each) => each.topic)));
  const frames = unique(bags.flatMap((bag) => bag.poses.map((each) => (each.frame && each.child_frame ? JSON.stringify([each.frame, each.child_frame]) : ""))));
  const scans = unique(files.filter((file) => file.scans).flatMap((file) => (bag_of(file)?.topics ?? []).filter((topic) => kScans.test(topic.type)).map((topic) => topic.name)));
  const fields: (Field | false)[] = [
    // A single one is no estimate if somebody names it, and goes before scans.
    topics.length > (with_scans ? 0 : 1) && { name: "truth_topic", kind: "menu", choices: words(topics), recognised: joined(taken.map((body) => body.id)) },
    frames.length > 1 && {
      name: "truth_frames", kind: "menu",
      choices: frames.map((each): [string, string[]] => { const pair = JSON.parse(each) as string[]; return [pair.join(" to "), pair]; }),
    },
    bodies.length > 1 && { name: "body", kind: "menu", choices: words(bodies), recognised: joined(taken.map((body) => body.name || body.id)) },
    scans.length > 1 && { name: "scan_topic", kind: "menu", choices: words(scans) },
    tracked.length > 0 && { name: "up", kind: "menu", choices: words(["x", "y", "z", "-x", "-y", "-z"]), recognised: joined(taken.map((body) => axis_of(body.up_by_positions))) },
    tracked.length > 0 && { name: "truth_unit", kind: "menu", choices: words(found.units.truth), recognised: joined(taken.map((body) => body.length_unit || "m")) },
    files.length > 0 && { name: "truth_mirrored", kind: "menu", choices: words(["yes", "no"]), recognised: "by the motion" },
  ];
  return fields.filter((each) => each !== false);
}

/** The tables whose columns are shown, of which the others of their kind are read in the same way. */
export const wheel_table_of = (found: Found) => found.files.find((file) => file.wheels && file.table);
export const truth_table_of = (found: Found) => found.files.find((file) => file.truth && !file.wheels && file.table);

/** Whether a statement about columns can be about this table: it has as many, and each is a role or the column's own name. */
function fits(stated: Statements[string], table: Table | null | undefined, roles: string[]): boolean {
  const names = String(stated).split(",");
  return !!table && names.length === table.columns && names.every((name, i) => name === "-" || roles.includes(name) || name === repeatable(table.names[i]));
}

/** The statements that the page still shows somewhere. Nobody could see or take back the others. */
export function shown_of(stated: Statements, found: Found): Statements {
  const fields = [...sizes_of(found), ...wheel_fields_of(found), ...truth_fields_of(found)];
  const is_shown = ([name, value]: [string, Statements[string]]) => {
    if (name === "wheel_columns") return fits(value, wheel_table_of(found)?.table, found.roles.wheels);
    if (name === "truth_columns") return fits(value, truth_table_of(found)?.table, found.roles.truth);
    const field = fields.find((each) => each.name === name);
    return field !== undefined && (field.kind !== "menu" || field.choices.some(([, each]) => JSON.stringify(each) === JSON.stringify(value)));
  };
  return Object.fromEntries(Object.entries(stated).filter(is_shown));
}

/** A name as a statement about columns can repeat it. */
export const repeatable = (name: string | undefined) => name?.replace(/[,=]/g, " ").trim() || "-";

/** An input that a remedy of an error can be pointed to. */
export const id_of = (name: string) => `statement-${name}`;

/** Holds the text as it is typed, so that nothing that happens meanwhile changes it. */
function NumberInput(props: { id: string; scale: number; value: number | undefined; set: (value: number | undefined) => void }) {
  const { scale, value } = props;
  const [text, type] = useState(value === undefined ? "" : String(Number((value / scale).toPrecision(12))));
  return (
    <input id={props.id} type="number" min="0" step="any" value={text}
      onInput={(event) => {
        const typed = event.currentTarget.value;
        type(typed);
        props.set(typed === "" ? undefined : Number((Number(typed) * scale).toPrecision(15)));
      }} />
  );
}

export function FieldInput(props: { field: Field; value: Statements[string] | undefined; set: (value: Statements[string] | undefined) => void }) {
  const { field, value, set } = props;
  const id = id_of(field.name);
  const hint = field.hint && <small>{field.hint}</small>;
  if (field.kind === "flag")
    return (
      <label class="flag" for={id}>
        <input id={id} type="checkbox" checked={value === true} onChange={(event) => set(event.currentTarget.checked || undefined)} />
        {kLabels[field.name]}
      </label>
    );
  if (field.kind === "number")
    return (
      <label for={id}>
        {kLabels[field.name]}
        {field.unit && `, ${field.unit}`}
        <NumberInput id={id} scale={field.scale} value={value as number | undefined} set={set} />
        {hint}
      </label>
    );
  const chosen = field.choices.findIndex(([, each]) => JSON.stringify(each) === JSON.stringify(value));
  return (
    <label for={id}>
      {kLabels[field.name]}
      <select id={id} value={chosen} onChange={(event) => set(field.choices[Number(event.currentTarget.value)]?.[1])}>
        <option value={-1}>as recognised{value === undefined && field.recognised && `: ${field.recognised}`}</option>
        {field.choices.map(([word], i) => (
          <option value={i} key={word}>
            {word}
          </option>
        ))}
      </select>
      {hint}
    </label>
  );
}
