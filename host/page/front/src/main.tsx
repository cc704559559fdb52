import "@picocss/pico/css/pico.min.css";
import "uplot/dist/uPlot.min.css";
import "./page.css";
import { render } from "preact";
import { useEffect, useState } from "preact/hooks";
import { chosen_backends } from "./backends";
import { DataPage } from "./data_page";
import { LivePage } from "./live/live_page";
import { Robot } from "./live/robot";
import { Strip } from "./live/strip";
import { SetupPage } from "./setup/setup_page";
import { TryPage } from "./try_page";

const { calls: backend, robot: reaches_robot } = chosen_backends();
const robot = new Robot(reaches_robot);
// A program that serves this page may have been told its robot, or another page may have chosen one.
if (reaches_robot.has_ports) void robot.open_present();

const kPages = [
  { at: "#try", name: "Try", title: "Try it on a simulated robot" },
  { at: "#data", name: "Your data", title: "Calibrate from your data" },
  { at: "#setup", name: "Set up", title: "Set up a robot" },
  { at: "#live", name: "Live", title: "Watch and drive a robot" },
];
const page_at = (hash: string) => kPages.find((each) => each.at === hash) ?? kPages[0]!;

/** All pages stay as they are while another is shown, so that nobody loses what was entered or found. */
function Page() {
  const [page, turn_to] = useState(page_at(location.hash));
  useEffect(() => {
    const turn = () => turn_to(page_at(location.hash));
    addEventListener("hashchange", turn);
    return () => removeEventListener("hashchange", turn);
  }, []);
  useEffect(() => {
    document.title = `${page.title} – Astrolabe`;
  }, [page]);
  return (
    <>
      <header class="container">
        <nav aria-label="Pages">
          <ul>
            <li>
              <strong>Astrolabe</strong>
            </li>
          </ul>
          <ul>
            {kPages.map((each) => (
              <li key={each.at}>
                <a href={each.at} aria-current={each === page ? "page" : undefined}>
                  {each.name}
                </a>
              </li>
            ))}
          </ul>
        </nav>
      </header>
      <Strip robot={robot} />
      <main class="container">
        <div hidden={page.at !== "#try"}>
          <TryPage backend={backend} />
        </div>
        <div hidden={page.at !== "#data"}>
          <DataPage backend={backend} />
        </div>
        <div hidden={page.at !== "#setup"}>
          <SetupPage robot={robot} />
        </div>
        <div hidden={page.at !== "#live"}>
          <LivePage robot={robot} />
        </div>
      </main>
    </>
  );
}

render(<Page />, document.getElementById("page")!);
