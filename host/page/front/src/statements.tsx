import { useState } from "preact/hooks";
import { bag_of, bodies_of, type Found } from "./drive_files";

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
export type Field = { name: string; hint: string } & (Menu | NumberField | Flag);

const words = (all: string[]): [string, string][] => all.map((each) => [each, each]);
const unique = (all: string[]) => [...new Set(all)];

export const kSizes: Field[] = [
  { name: "wheel_diameter", hint: "as the robot's program takes it", kind: "number", unit: "mm", scale: 0.001 },
  { name: "wheelbase", hint: "between the wheels, as the robot's program takes it", kind: "number", unit: "mm", scale: 0.001 },
  { name: "counts_per_turn", hint: "of the wheel, for wheels in counts", kind: "number", unit: "", scale: 1 },
];

/** The menus that these files have a use for. */
export function fields_of(found: Found): Field[] {
  const bags = found.files.map(bag_of).filter((each) => each !== null);
  const bodies = unique(found.files.flatMap((file) => bodies_of(file).map((body) => body.name || body.id)).filter((name) => name !== ""));
  const sources = unique(bags.flatMap((bag) => bag.wheel_sources.map((each) => each.name)));
  const poses = unique(bags.flatMap((bag) => bag.poses.map((each) => each.topic)));
  const joints = unique(bags.flatMap((bag) => bag.joints));
  const pairs = joints.flatMap((left) => joints.filter((right) => right !== left).map((right): [string, string[]] => [`${left} left, ${right} right`, [left, right]]));
  const tables = found.files.some((file) => file.wheels && file.table);
  const wheels = found.files.some((file) => file.wheels);
  const truth = found.files.some((file) => file.truth);
  const fields: (Field | false)[] = [
    sources.length > 1 && { name: "wheels_topic", hint: "", kind: "menu", choices: words(sources) },
    bags.some((bag) => bag.wheel_sources.some((each) => each.unit === null)) && {
      name: "wheels_unit", hint: "", kind: "menu", choices: words(found.units.wheels),
    },
    pairs.length > 0 && pairs.length <= 90 && { name: "joints", hint: "", kind: "menu", choices: pairs },
    poses.length > 1 && { name: "truth_topic", hint: "", kind: "menu", choices: words(poses) },
    bodies.length > 1 && { name: "body", hint: "", kind: "menu", choices: words(bodies) },
    tables && { name: "per_interval", hint: "", kind: "flag" },
    wheels && { name: "counter_range", hint: "as 65536; found from the data if it is empty", kind: "number", unit: "counts", scale: 1 },
    wheels && { name: "swap_wheels", hint: "", kind: "flag" },
    wheels && { name: "reverse_wheels", hint: "", kind: "flag" },
    wheels && { name: "drives_backward", hint: "", kind: "flag" },
    truth && { name: "up", hint: "", kind: "menu", choices: words(["x", "y", "z", "-x", "-y", "-z"]) },
    truth && { name: "truth_unit", hint: "", kind: "menu", choices: words(found.units.truth) },
    truth && { name: "truth_mirrored", hint: "", kind: "menu", choices: words(["yes", "no"]) },
  ];
  return fields.filter((each) => each !== false);
}

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
        <option value={-1}>as recognised</option>
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
