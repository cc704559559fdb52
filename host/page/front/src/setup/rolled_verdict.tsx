import type { ComponentChildren } from "preact";
import { changes_text, type Values } from "./put_in_force";
import { type StepProps, type use_work, Verdict } from "./step";

/** What the core says of a way that was measured: whether the robot's counts fit it, and what to load if not. */
export interface Rolled {
  agrees: boolean;
  sentence: string;
  parameters: Values;
}

interface Props extends Pick<StepProps, "robot" | "load" | "finish">, Pick<ReturnType<typeof use_work>, "busy" | "work"> {
  rolled: Rolled;
  /** What is noted if the counts fit. */
  agreed: string;
  children?: ComponentChildren; // a further button
}

export function RolledVerdict({ robot, load, finish, busy, work, rolled, agreed, children }: Props) {
  const { agrees, sentence, parameters } = rolled;
  const mends = Object.keys(parameters).length > 0;
  const mend = () =>
    work(async () => {
      if (await load(parameters, true)) finish([`mended: ${sentence}`]);
    });
  return (
    <Verdict good={agrees}>
      <p>{sentence}</p>
      {mends && <p>To be loaded: {changes_text(robot, parameters)}.</p>}
      <div class="row">
        {agrees && <button type="button" onClick={() => finish([agreed])}>Go on</button>}
        {mends && <button type="button" disabled={busy} aria-busy={busy} onClick={mend}>Mend it: load them</button>}
        {children}
      </div>
    </Verdict>
  );
}
