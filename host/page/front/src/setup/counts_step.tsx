import { useState } from "preact/hooks";
import { type Length, LengthField } from "./length_field";
import { parameter } from "./put_in_force";
import { type Rolled, RolledVerdict } from "./rolled_verdict";
import { Problem, type StepProps, use_work } from "./step";

const kTurns = 10;

/** The robot is rolled by hand: do its wheels count as its parameters say? */
export function CountsStep({ robot, progress, load, finish }: StepProps) {
  const [rolls, set_rolls] = useState(false);
  const [length, set_length] = useState<Length>({ value: kTurns, unit: "turns" });
  const [rolled, judge] = useState<Rolled | null>(null);
  const { busy, problem, work } = use_work();
  const simulated = progress.question.simulated !== undefined;
  const begin = () =>
    work(async () => {
      judge(null);
      await robot.backend.ask("robot/roll", { begin: true });
      set_rolls(true);
      if (!simulated) return;
      const { turns } = await robot.backend.ask<{ turns: number }>("robot/push", { turns: kTurns });
      set_length({ value: Number(turns.toFixed(2)), unit: "turns" });
    });
  const compare = () =>
    work(async () => {
      judge(await robot.backend.ask<Rolled>("robot/roll", length.unit === "m" ? { distance_m: length.value } : { turns: length.value }));
      set_rolls(false);
    });
  const metres = kTurns * Math.PI * parameter(robot, "wheel_diameter");
  return (
    <>
      <p>
        Put the robot on the floor and mark a wheel where it touches. Roll the robot straight on by hand for {kTurns} turns of that
        wheel, about {metres.toFixed(2)} m, and watch the mark. A measured way in metres does as well.
      </p>
      {!rolls && !rolled && (
        <button type="button" disabled={busy} aria-busy={busy} onClick={begin}>
          {simulated ? `Roll it by hand for ${kTurns} turns` : "Begin: it stands at its mark"}
        </button>
      )}
      {rolls && !busy && (
        <form class="settings" onSubmit={(event) => { event.preventDefault(); compare(); }}>
          <LengthField label="It rolled" length={length} set={set_length} units={["turns", "m"]} />
          <button type="submit">Compare with what it counted</button>
        </form>
      )}
      {rolled && (
        <RolledVerdict {...{ robot, load, finish, busy, work, rolled }} agreed={rolled.sentence}>
          <button type="button" class="secondary" disabled={busy} onClick={begin}>Roll again</button>
        </RolledVerdict>
      )}
      <Problem sentence={problem} />
    </>
  );
}
