import { useState } from "preact/hooks";
import type { StepProps } from "./step";
import { kSimulator, kTruths } from "./truths";

/** Which ground truth is at hand decides how the robot is calibrated. */
export function TruthStep({ progress, change, finish }: StepProps) {
  const choices = [
    ...(progress.question.simulated ? [{ name: kSimulator, what: "the simulator, which knows where its robot is", minutes: "1", error: "as a tracker" }] : []),
    ...kTruths,
  ];
  const [chosen, choose] = useState(progress.truth || choices[0]!.name);
  const take = () => {
    change((before) => ({ ...before, truth: chosen }));
    finish([choices.find((each) => each.name === chosen)!.what]);
  };
  return (
    <>
      <p>
        The robot drives squares, and something has to say where it really was. What do you have? Drives that you have recorded
        already belong on the page <a href="#data">Your data</a>.
      </p>
      <div class="wide" tabIndex={0} role="group" aria-label="Ground truths">
        <table class="truths">
          <thead>
            <tr>
              <th scope="col">You have</th>
              <th scope="col">Minutes</th>
              <th scope="col">Error of wheels / wheelbase</th>
            </tr>
          </thead>
          <tbody>
            {choices.map(({ name, what, minutes, error }) => (
              <tr key={name}>
                <th scope="row">
                  <label>
                    <input type="radio" name="truth" checked={chosen === name} onChange={() => choose(name)} />
                    {what}
                  </label>
                </th>
                <td>{minutes}</td>
                <td>{error}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
      <button type="button" onClick={take}>Go on with this</button>
    </>
  );
}
