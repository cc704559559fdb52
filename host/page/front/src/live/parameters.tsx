import { useEffect, useRef, useState } from "preact/hooks";
import { Refusal, sentence_of } from "../backend";
import { Confirm } from "./confirm";
import type { Parameter } from "./contract";
import type { Robot } from "./robot";
import { use_robot } from "./use_robot";
import { unit_text } from "./words";

const is_text = (parameter: Parameter) => typeof parameter.value === "string";

function Row(props: { parameter: Parameter; problem: string; stage: (value: number | string) => void }) {
  const { parameter, problem, stage } = props;
  const { name, unit, value, min, max } = parameter;
  const now = parameter.staged ?? value;
  const id = `parameter-${name}`;
  const input = useRef<HTMLInputElement>(null);
  const show = () => (input.current!.value = String(now));
  useEffect(() => void show(), [now]);
  const enter = (typed: string) => {
    if (typed === String(now)) return;
    if (!is_text(parameter) && typed === "") show();
    else stage(is_text(parameter) ? typed : Number(typed));
  };
  const standard = parameter.default ?? null;
  return (
    <tr class={parameter.staged === null ? "" : "staged"}>
      <th scope="row">
        <label for={id}>{name}</label>
        <small id={`${id}-doc`}>{parameter.doc}</small>
        {problem && <small role="alert" class="against">{problem}</small>}
      </th>
      <td>
        <span class="entered">
          <input ref={input} id={id} type={is_text(parameter) ? "text" : "number"} step="any" aria-describedby={`${id}-doc`}
            aria-invalid={problem ? "true" : undefined} onChange={(event) => enter(event.currentTarget.value)}
            onKeyDown={(event) => event.key === "Escape" && show()} />
          {unit_text(unit)}
        </span>
        <small>{parameter.staged !== null ? `now ${value}` : is_text(parameter) ? `${min} to ${max} characters` : `${min} to ${max}`}</small>
      </td>
      <td>
        {standard !== null && standard !== now && (
          <button type="button" class="outline secondary" aria-label={`${name}: the default, ${standard}`} onClick={() => stage(standard)}>
            {standard}
          </button>
        )}
      </td>
    </tr>
  );
}

/** The robot's parameters. What is edited is staged, and put in force all together. */
export function Parameters({ robot }: { robot: Robot }) {
  const parameters = use_robot(robot, (each) => each.parameters);
  const [wanted, filter] = useState("");
  const [problems, set_problems] = useState<Record<string, string>>({});
  const [far, set_far] = useState<string[]>([]);
  const [problem, set_problem] = useState("");
  const [question, set_question] = useState("");
  const [busy, set_busy] = useState(false);
  const shown = parameters.filter(({ name, doc }) => `${name} ${doc}`.toLowerCase().includes(wanted.trim().toLowerCase()));
  const staged = parameters.filter((each) => each.staged !== null);

  const stage = async (name: string, value: number | string) => {
    try {
      const answer = await robot.backend.ask<{ far: string[] }>("robot/stage", { name, value });
      set_far(answer.far);
      set_problems(({ [name]: _, ...others }) => others);
      await robot.read_parameters();
    } catch (error) {
      set_problems((before) => ({ ...before, [name]: sentence_of(error) }));
    }
  };
  const finish = async (call: string, question_of_call: object) => {
    set_busy(true);
    set_problem("");
    set_question("");
    try {
      await robot.backend.ask(call, question_of_call);
      set_problems({});
      set_far([]);
      await robot.read_parameters();
    } catch (error) {
      if (error instanceof Refusal && error.remedies.includes("confirm")) set_question(error.message);
      else set_problem(sentence_of(error));
    }
    set_busy(false);
  };

  return (
    <section aria-label="Parameters" class="panel parameters">
      <div class="head">
        <h2>Parameters</h2>
        <span class="spring" />
        <input type="search" aria-label="Parameters with this word" placeholder="Find" value={wanted} onInput={(event) => filter(event.currentTarget.value)} />
      </div>
      <div class="wide" tabIndex={0} role="group" aria-label="Table of parameters">
        <table>
          <thead>
            <tr>
              <th scope="col">Parameter</th>
              <th scope="col">Value</th>
              <th scope="col">Default</th>
            </tr>
          </thead>
          <tbody>
            {shown.map((each) => (
              <Row key={each.name} parameter={each} problem={problems[each.name] ?? ""} stage={(value) => void stage(each.name, value)} />
            ))}
          </tbody>
        </table>
        {shown.length === 0 && <p>No parameter has this word in its name or description.</p>}
      </div>
      {staged.length > 0 && (
        <div class="commit" role="status">
          <p>
            <strong>{staged.length === 1 ? "1 change is" : `${staged.length} changes are`} staged</strong>, none is in force yet: {staged.map(({ name, value, staged: next }) => `${name} ${value} → ${next}`).join(", ")}
          </p>
          {far.map((sentence) => <p key={sentence}><small>{sentence}</small></p>)}
          <div class="row">
            <button type="button" disabled={busy} aria-busy={busy} onClick={() => void finish("robot/commit", {})}>Commit</button>
            <button type="button" class="secondary" disabled={busy} onClick={() => void finish("robot/discard", {})}>Discard</button>
          </div>
        </div>
      )}
      {problem && <p role="alert" class="problem">{problem}</p>}
      {question && <Confirm sentence={question} yes="Commit all the same" decide={(yes) => (yes ? void finish("robot/commit", { confirm: true }) : set_question(""))} />}
    </section>
  );
}
