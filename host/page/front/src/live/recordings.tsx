import { useEffect, useState } from "preact/hooks";
import { drop_recording, left_recording, left_recordings } from "./kept_recordings";
import type { Robot } from "./robot";
import { use_robot } from "./use_robot";

function Entry(props: { name: string; note?: string; given: boolean; save: () => Promise<void>; remove: () => Promise<void>; refuse: (why: unknown) => void }) {
  const { name, given } = props;
  const act = (word: string, classes: string, action: () => Promise<void>) => (
    <button type="button" class={classes} aria-label={`${word} ${name}`} onClick={() => void action().catch(props.refuse)}>{word}</button>
  );
  return (
    <li>
      <span>
        {name}{" "}
        <small>{given ? "given to the browser: look whether it is among your downloads, then remove it here" : props.note}</small>
      </span>
      <span class="spring" />
      {act(given ? "Save again" : "Save", given ? "outline secondary" : "", props.save)}
      {act(given ? "Remove" : "Discard", given ? "" : "outline secondary", props.remove)}
    </li>
  );
}

/** Recordings that have ended, with their robot or with an earlier page, until a person removes them. */
export function Recordings({ robot }: { robot: Robot }) {
  const ended = use_robot(robot, (each) => each.recordings), given = use_robot(robot, (each) => each.given);
  const [left, set_left] = useState<string[]>([]);
  const look = () => void left_recordings().then(set_left);
  useEffect(look, []);
  if (ended.length + left.length === 0) return null;
  const refuse = (why: unknown) => robot.refuse(why);
  return (
    <section aria-label="Recordings" class="panel recordings">
      <h2>Recordings</h2>
      <ul>
        {ended.map((file) => (
          <Entry key={file} name={file} given={given.has(file)} refuse={refuse}
            save={() => robot.save_recording(file)} remove={() => robot.remove_recording(file)} />
        ))}
        {left.map((name) => (
          <Entry key={name} name={name} note="of a page that was closed; its last seconds may be missing" given={given.has(name)} refuse={refuse}
            save={async () => robot.give(name, await left_recording(name))}
            remove={async () => {
              await drop_recording(name);
              robot.was_removed(name);
              look();
            }}
          />
        ))}
      </ul>
    </section>
  );
}
