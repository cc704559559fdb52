import { useEffect, useRef } from "preact/hooks";
import uPlot from "uplot";

export interface Series {
  name: string;
  /** A colour of page.css. */
  colour: string;
  values: (number | null)[];
}

/** Values over time. Gaps are where a value is null. */
export function Plot(props: { title: string; unit: string; times: number[]; series: Series[] }) {
  const place = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const element = place.current;
    if (!element) return;
    const dark = matchMedia("(prefers-color-scheme: dark)");
    let plot: uPlot | undefined;
    const draw = () => {
      plot?.destroy();
      const style = getComputedStyle(element);
      const axis: uPlot.Axis = {
        stroke: style.getPropertyValue("--pico-color"),
        grid: { stroke: style.getPropertyValue("--pico-muted-border-color"), width: 1 },
        ticks: { stroke: style.getPropertyValue("--pico-muted-border-color"), width: 1 },
      };
      plot = new uPlot(
        {
          width: element.clientWidth,
          height: 200,
          scales: { x: { time: false } },
          cursor: { y: false },
          axes: [{ ...axis, label: "s", labelSize: 20 }, { ...axis, label: props.unit, labelSize: 20, size: 65 }],
          series: [
            { label: "s" },
            ...props.series.map((each) => ({
              label: each.name,
              stroke: style.getPropertyValue(each.colour),
              width: 1.5,
            })),
          ],
        },
        [props.times, ...props.series.map((each) => each.values)],
        element,
      );
    };
    // A closed part of the page has no width; it is drawn when it opens.
    const observer = new ResizeObserver(() => {
      if (element.clientWidth === 0) return;
      if (plot) plot.setSize({ width: element.clientWidth, height: 200 });
      else draw();
    });
    observer.observe(element);
    const recolour = () => plot && draw();
    dark.addEventListener("change", recolour);
    return () => {
      observer.disconnect();
      dark.removeEventListener("change", recolour);
      plot?.destroy();
    };
  }, [props.times, props.series]);
  return <div class="plot" ref={place} role="img" aria-label={props.title} />;
}
