import { useState } from "preact/hooks";
import { type Event_, Refusal } from "../backend";
import type { Robot } from "../live/robot";
import { type Length, LengthField } from "./length_field";
import { type Rolled, RolledVerdict } from "./rolled_verdict";
import { Problem, type StepProps, use_work } from "./step";

/** Until the path that is driven ends; rejects if it ends early. */
function end_of_path(robot: Robot): Promise<void> {
  return new Promise((resolve, reject) => {
    const leave = robot.backend.listen((event: Event_) => {
      if (event.event === "connection" && !event.up) leave(), reject(new Refusal("the robot was lost on its way"));
      if (event.event !== "path" || event.ended === null) return;
      leave();
      if (event.ended === "finished") resolve();
      else reject(new Refusal(event.ended as string));
    });
  });
}

/** How far the simulated robot has really come, if somebody sees it. */
const seen_m = (robot: Robot, from: { x_m: number; y_m: number } | null) => {
  const to = robot.truth.pose;
  return from && to ? Number(Math.hypot(to.x_m - from.x_m, to.y_m - from.y_m).toFixed(3)) : 1;
};

/** The robot drives a metre by itself, and a person measures it. */
export function MetreStep({ robot, load, finish }: StepProps) {
  const [driven, set_driven] = useState(false);
  const [length, set_length] = useState<Length>({ value: 1, unit: "m" });
  const [rolled, judge] = useState<Rolled | null>(null);
  const { busy, problem, work } = use_work();
  const drive = () =>
    work(async () => {
      judge(null);
      set_driven(false);
      const { left } = robot;
      const require_somebody = () => {
        if (robot.left !== left) throw new Refusal("nobody was looking any more, so nothing was driven");
      };
      const from = robot.truth.pose;
      await robot.backend.ask("robot/roll", { begin: true });
      require_somebody();
      await robot.ask_to_drive("robot/arm", {});
      try {
        require_somebody();
        const ended = end_of_path(robot);
        await robot.ask_to_drive("robot/path", { kind: "line", size_m: 1, speed_mps: 0.2 });
        await ended;
      } finally {
        await robot.backend.ask("robot/disarm", {}).catch(() => {}); // why the drive ended is what counts
      }
      set_length({ value: seen_m(robot, from), unit: "m" });
      set_driven(true);
    });
  const compare = () => work(async () => judge(await robot.backend.ask<Rolled>("robot/roll", { distance_m: length.value })));
  return (
    <>
      <p>Mark where the robot stands, and keep 1.5 m ahead of it free. It drives one metre by itself, slowly; then measure how far it came.</p>
      {!driven && (
        <button type="button" disabled={busy} aria-busy={busy} onClick={drive}>The floor is free: drive one metre</button>
      )}
      {driven && (
        <form class="settings" onSubmit={(event) => { event.preventDefault(); compare(); }}>
          <LengthField label="It came" length={length} set={set_length} units={["m"]} />
          <button type="submit" disabled={busy}>Compare</button>
          <button type="button" class="secondary" disabled={busy} onClick={drive}>Drive another metre</button>
        </form>
      )}
      {rolled && (
        <RolledVerdict
          {...{ robot, load, finish, busy, work, rolled }}
          agreed={`one metre was ${length.value} m: ${rolled.sentence}`}
        />
      )}
      <Problem sentence={problem} />
    </>
  );
}
