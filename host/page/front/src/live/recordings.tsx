import { useEffect, useState } from "preact/hooks";
import { save } from "../saving";
import { drop_recording, left_recording, left_recordings } from "./kept_recordings";
import type { Robot } from "./robot";
import { use_robot } from "./use_robot";

function Entry(props: { name: string; note?: string; save: () => Promise<void>; discard: () => Promise<void>; refuse: (why: unknown) => void }) {
  const { name } = props;
  return (
    <li>
      <span>
        {name} {props.note && <small>{props.note}</small>}
      </span>
      <span class="spring" />
      <button type="button" aria-label={`Save ${name}`} onClick={() => void props.save().catch(props.refuse)}>Save</button>
      <button type="button" class="outline secondary" aria-label={`Discard ${name}`} onClick={() => void props.discard().catch(props.refuse)}>Discard</button>
    </li>
  );
}

/** Recordings that have ended, with their robot or with an earlier page, and that nobody has saved. */
export function Recordings({ robot }: { robot: Robot }) {
  const unsaved = use_robot(robot, (each) => each.unsaved);
  const [left, set_left] = useState<string[]>([]);
  const look = () => void left_recordings().then(set_left);
  useEffect(look, []);
  if (unsaved.length + left.length === 0) return null;
  const refuse = (why: unknown) => robot.refuse(why);
  const drop = async (name: string) => {
    await drop_recording(name);
    look();
  };
  return (
    <section aria-label="Recordings" class="panel recordings">
      <h2>Recordings that are not saved</h2>
      <ul>
        {unsaved.map((file) => (
          <Entry key={file} name={file} refuse={refuse} save={() => robot.save_recording(file)} discard={() => robot.drop_recording(file)} />
        ))}
        {left.map((name) => (
          <Entry key={name} name={name} note="of a page that was closed; its last seconds may be missing" refuse={refuse}
            save={async () => {
              save(name, await left_recording(name));
              await drop(name);
            }}
            discard={() => drop(name)}
          />
        ))}
      </ul>
    </section>
  );
}
