import { useRef, useState } from "preact/hooks";
import { type Backend, type Event_, sentence_of } from "./backend";
import { kChoices, kUsual, question_of, Slider } from "./choices";
import { type Factors, FactorTable } from "./factors";
import { save } from "./saving";
import { type Way, Ways } from "./ways";

interface Answer {
  results: {
    before: { E_max_syst_m?: number };
    after: { E_max_syst_m?: number } | null;
    improvement: number | null;
    parameters: { old: Factors; new: Factors | null; standard_errors?: Factors };
  };
  built: Factors;
  verdict: string;
  report: string;
}

type State = "ready" | "driving" | "done" | "refused";

/** A robot drives a square in a seventh of a second or so: more pictures take time from it and show nothing more. */
const kBetweenPictures_ms = 40;

/** A simulated robot drives squares as one watches, is calibrated, and drives them again. */
export function TryPage({ backend }: { backend: Backend }) {
  const [chosen, choose] = useState(kUsual);
  const [state, enter] = useState<State>("ready");
  const [progress, show_progress] = useState({ title: "", number: 0, total: 0 });
  const [answer, take] = useState<Answer | null>(null);
  const [report, set_report] = useState("");
  const [problem, set_problem] = useState("");
  const ways = useRef<Way[]>([]);
  const [, drawn] = useState(0);
  const pending = useRef(false);

  const redraw = () => {
    if (pending.current) return;
    pending.current = true;
    setTimeout(() => {
      pending.current = false;
      drawn((n) => n + 1);
    }, kBetweenPictures_ms);
  };

  const told = (event: Event_) => {
    if (event.event === "run") {
      ways.current.push({ phase: event.phase as string, odometry: [], truth: [] });
      show_progress({ title: event.title as string, number: event.number as number, total: event.total as number });
    } else if (event.event === "way") {
      const last = ways.current.at(-1);
      last?.odometry.push(...(event.odometry as number[]));
      last?.truth.push(...(event.truth as number[]));
    }
    redraw();
  };

  const drive = async () => {
    ways.current = [];
    take(null);
    set_problem("");
    set_report("");
    enter("driving");
    try {
      const found = await backend.ask<Answer>("try_out", question_of(chosen), told);
      take(found);
      set_report(await (await backend.file(found.report)).text());
      enter("done");
    } catch (error) {
      set_problem(sentence_of(error));
      enter("refused");
    }
  };

  const driving = state === "driving";
  const of = (phase: string) => ways.current.filter((way) => way.phase === phase);
  return (
    <>
      <h1>Try it on a simulated robot</h1>
      <p>
        The robot drives squares of 3 m both ways and believes its odometry. Then it is calibrated from what eight cameras saw, and
        drives them again. All of it is computed in this page: the robot's firmware, its motors and the calibration.
      </p>
      <div class="grid">
        <form
          aria-label="The robot"
          onSubmit={(event) => {
            event.preventDefault();
            void drive();
          }}
        >
          {kChoices.map((each) => (
            <Slider key={each.name} choice={each} value={chosen[each.name]!} disabled={driving}
              set={(value) => choose({ ...chosen, [each.name]: value })} />
          ))}
          <button type="submit" aria-busy={driving} disabled={driving}>
            {driving ? "Driving" : "Drive and calibrate"}
          </button>
          {driving && <progress value={progress.number} max={progress.total} aria-label="Drives of this phase" />}
          <p role="status">{driving && `${progress.title} (${progress.number} of ${progress.total})`}</p>
          {problem && <p role="alert">{problem}</p>}
        </form>
        <div class="phases">
          {["before", "after"].map((phase) => (
            <figure key={phase}>
              <figcaption>
                {phase === "before" ? "Before" : "After"} <small>
                  <span class="odometry">odometry</span> and <span class="truth">where it really is</span>
                </small>
              </figcaption>
              <Ways ways={of(phase)} label={`Ways of the drives ${phase} calibration`} />
            </figure>
          ))}
        </div>
      </div>
      {answer && (
        <section aria-label="Result">
          <h2>Result</h2>
          <p>{answer.verdict}</p>
          <FactorTable
            columns={[
              { title: "Before", factors: answer.results.parameters.old },
              { title: "Found", factors: answer.results.parameters.new },
              { title: "±", factors: answer.results.parameters.standard_errors },
              { title: "As it was built", factors: answer.built },
            ]}
          />
          {report && (
            <>
              <button type="button" class="secondary" onClick={() => save("report.html", new Blob([report], { type: "text/html" }))}>
                Save the report
              </button>
              <iframe srcdoc={report} title="Report" sandbox="allow-scripts" />
            </>
          )}
        </section>
      )}
    </>
  );
}
