import type { ComponentChildren } from "preact";
import { useState } from "preact/hooks";
import { sentence_of } from "../backend";
import type { Robot } from "../live/robot";
import type { Change, Progress } from "./progress";
import type { Values } from "./put_in_force";

/** What each step gets. */
export interface StepProps {
  robot: Robot;
  progress: Progress;
  change: Change;
  /** Puts values in force and keeps them. Answers false if a person had to confirm that and did not. */
  load: (values: Values, confirmed: boolean) => Promise<boolean>;
  /** Simulates the robot anew with these faults of its wires: somebody has changed them by hand. */
  rewire: (wiring: string[]) => Promise<void>;
  /** The step is over, and this was found. */
  finish: (lines: string[]) => void;
}

/** Whether something is under way, why it failed, and how to begin it. */
export function use_work() {
  const [busy, set_busy] = useState(false);
  const [problem, set_problem] = useState("");
  const work = async (what: () => Promise<void>) => {
    set_busy(true);
    set_problem("");
    try {
      await what();
    } catch (error) {
      set_problem(sentence_of(error));
    }
    set_busy(false);
  };
  return { busy, problem, work: (what: () => Promise<void>) => void work(what) };
}

export function Problem({ sentence }: { sentence: string }) {
  return sentence ? <p role="alert" class="problem">{sentence}</p> : null;
}

/** What a step found, and what can be done about it. */
export function Verdict({ good, children }: { good: boolean; children: ComponentChildren }) {
  return <div role="status" class={good ? "verdict good" : "verdict"}>{children}</div>;
}
