import { save } from "../saving";
import { kSteps } from "./progress";
import { robot_sheet } from "./robot_sheet";
import { Problem, type StepProps, use_work } from "./step";

/** What was found, to be kept and sent. */
export function SheetStep({ robot, progress, begin_anew }: StepProps & { begin_anew: () => void }) {
  const { busy, problem, work } = use_work();
  const opened = robot.opened!;
  const name = (opened.name || "robot").replace(/[^A-Za-z0-9_-]+/g, "-");
  const save_page = () =>
    work(async () => {
      await robot.read_parameters();
      save(`${name}.html`, new Blob([robot_sheet(opened, robot.parameters, progress)], { type: "text/html" }));
    });
  const save_toml = () =>
    work(async () => {
      const { file } = await robot.backend.ask<{ file: string }>("robot/export", {});
      save(`${name}.toml`, await robot.backend.file(file));
    });
  return (
    <>
      <dl class="sheet">
        {kSteps.filter((each) => progress.done[each.name]).map(({ name: step, title }) => (
          <div key={step}>
            <dt>{title}</dt>
            {progress.done[step]!.skipped ? <dd class="muted">skipped</dd> : progress.done[step]!.lines.map((line) => <dd key={line}>{line}</dd>)}
          </div>
        ))}
      </dl>
      <div class="row">
        <button type="button" disabled={busy} onClick={save_page}>Save this robot's page</button>
        <button type="button" class="secondary" disabled={busy} onClick={save_toml}>Save its parameters as TOML</button>
        <button type="button" class="outline secondary" disabled={busy} onClick={begin_anew}>Set up another robot</button>
      </div>
      <p>Now watch and drive it on the page <a href="#live">Live</a>.</p>
      <Problem sentence={problem} />
    </>
  );
}
