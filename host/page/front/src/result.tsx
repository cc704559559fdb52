import type { Calibrated } from "./drive_files";
import { FactorTable } from "./factors";
import { save } from "./saving";

/** What a calibration found, and its files to save. */
export function Result(props: { found: Calibrated; report: string; file: (path: string) => Promise<Blob> }) {
  const { found } = props;
  const download = async (path: string) => save(path.split("/").at(-1)!, await props.file(path));
  return (
    <section aria-label="Result">
      <h2>Result</h2>
      <p class={found.advises_against ? "against" : ""}>{found.verdict}</p>
      <FactorTable
        columns={[
          { title: "Loaded", factors: found.calibration.carried ?? found.calibration.loaded },
          { title: "Found", factors: found.calibration },
          { title: "±", factors: found.calibration.standard_errors },
          ...(found.calibration.standard_errors_another_day ? [{ title: "± another day", factors: found.calibration.standard_errors_another_day }] : []),
        ]}
      />
      {found.not_in_ros2 && <p>{found.ros2 ? "" : "There is no file for diff_drive_controller: "}{found.not_in_ros2}</p>}
      <div class="row">
        {found.ros2 && (
          <button type="button" onClick={() => void download(found.ros2!)}>
            Save for diff_drive_controller
          </button>
        )}
        <button type="button" class="secondary" onClick={() => void download(found.toml)}>
          Save as TOML
        </button>
        {found.report && (
          <button type="button" class="secondary" onClick={() => void download(found.report!)}>
            Save the report
          </button>
        )}
      </div>
      <details>
        <summary>What was found in each drive</summary>
        {found.remarks.length > 0 && (
          <ul>
            {found.remarks.map((remark) => (
              <li key={remark}>{remark}</li>
            ))}
          </ul>
        )}
        {found.drives.map((drive) => (
          <div key={drive.name}>
            <p>
              <strong>{drive.name}</strong>: {drive.summary}
            </p>
            {drive.remarks.length > 0 && (
              <ul>
                {drive.remarks.map((remark) => (
                  <li key={remark}>{remark}</li>
                ))}
              </ul>
            )}
          </div>
        ))}
      </details>
      {props.report && <iframe srcdoc={props.report} title="Report" sandbox="allow-scripts" />}
    </section>
  );
}
