import { useState } from "preact/hooks";
import { kChoices, kUsual, question_of, Slider } from "../choices";
import { RealRobot } from "../live/connect";
import type { Robot } from "../live/robot";
import type { Progress } from "./progress";
import { Problem } from "./step";

const kWiring = [
  { name: "motors-swapped", title: "the motors are swapped" },
  { name: "right-encoder-reversed", title: "the right encoder counts backward" },
  { name: "left-motor-reversed", title: "the left motor turns backward" },
];
/** Counts per motor turn of an encoder of which every second edge is counted; the parameters of the robot say 64. */
const kWrongCounts = 32;

/** The robot to be set up: found at a port, simulated, or the one that is open. */
export function RobotStep(props: { robot: Robot; busy: boolean; problem: string; begin: (question: Progress["question"]) => void }) {
  const { robot, busy, problem, begin } = props;
  const [chosen, choose] = useState(kUsual);
  const [wrong, set_wrong] = useState(["motors-swapped", "right-encoder-reversed"]);
  const [wrong_counts, set_wrong_counts] = useState(true);
  const simulate = () => begin({ simulated: { ...question_of(chosen), wiring: wrong, ...(wrong_counts ? { counts_per_motor_rev: kWrongCounts } : {}) } });
  const toggle = (name: string, on: boolean) => set_wrong(on ? [...wrong, name] : wrong.filter((each) => each !== name));
  if (robot.opened)
    return (
      <>
        <p>The robot {robot.opened.name || robot.opened.hardware} is open.</p>
        <div class="row">
          <button type="button" disabled={busy} onClick={() => begin(robot.opened!.simulated ? { simulated: {} } : { port: robot.opened!.port })}>Set it up</button>
          <button type="button" class="secondary" disabled={busy} onClick={() => void robot.close()}>Leave it and choose another</button>
        </div>
        <Problem sentence={problem} />
      </>
    );
  return (
    <>
      <Problem sentence={problem} />
      <div class="robots">
        <RealRobot robot={robot} busy={busy} open={begin} />
        <article aria-label="A simulated robot">
          <h2>A simulated robot</h2>
          <p>As somebody has just built it, with mistakes to be found.</p>
          <fieldset disabled={busy}>
            <legend>What is wrong with it</legend>
            {kWiring.map(({ name, title }) => (
              <label key={name}><input type="checkbox" checked={wrong.includes(name)} onChange={(event) => toggle(name, event.currentTarget.checked)} />{title}</label>
            ))}
            <label><input type="checkbox" checked={wrong_counts} onChange={(event) => set_wrong_counts(event.currentTarget.checked)} />its encoders count half of what its parameters say</label>
          </fieldset>
          <details>
            <summary>How else it is built</summary>
            {kChoices.map((each) => (
              <Slider key={each.name} choice={each} value={chosen[each.name]!} disabled={busy} set={(value) => choose({ ...chosen, [each.name]: value })} />
            ))}
          </details>
          <button type="button" disabled={busy} aria-busy={busy} onClick={simulate}>Simulate this robot</button>
        </article>
      </div>
    </>
  );
}
