/** A piece of the floor seen from above: x to the right and y up, m. */
export interface Box {
  left: number;
  right: number;
  bottom: number;
  top: number;
}

/** The least box in which `least_m` around the origin and `margin_m` around all these points (x and y in turn) lie. */
export function box_of(lines: number[][], least_m: number, margin_m = 0): Box {
  const box = { left: -least_m, right: least_m, bottom: -least_m, top: least_m };
  for (const points of lines)
    for (let i = 0; i + 1 < points.length; i += 2) {
      box.left = Math.min(box.left, points[i]! - margin_m);
      box.right = Math.max(box.right, points[i]! + margin_m);
      box.bottom = Math.min(box.bottom, points[i + 1]! - margin_m);
      box.top = Math.max(box.top, points[i + 1]! + margin_m);
    }
  return box;
}

/** Draws on a canvas that shows a box of the floor as large as it can. */
export class Plan {
  readonly context: CanvasRenderingContext2D;
  readonly scale = devicePixelRatio;
  /** Canvas pixels per metre. */
  readonly zoom: number;
  private readonly x0: number;
  private readonly y0: number;

  constructor(
    readonly canvas: HTMLCanvasElement,
    box: Box,
  ) {
    this.context = canvas.getContext("2d")!;
    const [width, height] = [Math.round(canvas.clientWidth * this.scale), Math.round(canvas.clientHeight * this.scale)];
    // A new size clears the canvas, too, but takes new memory each time.
    if (canvas.width === width && canvas.height === height) this.context.clearRect(0, 0, width, height);
    else [canvas.width, canvas.height] = [width, height];
    const margin = 14 * this.scale;
    this.zoom = Math.min((canvas.width - 2 * margin) / (box.right - box.left), (canvas.height - 2 * margin) / (box.top - box.bottom));
    this.x0 = canvas.width / 2 - (this.zoom * (box.left + box.right)) / 2;
    this.y0 = canvas.height / 2 + (this.zoom * (box.bottom + box.top)) / 2;
  }

  at(x_m: number, y_m: number): [number, number] {
    return [this.x0 + this.zoom * x_m, this.y0 - this.zoom * y_m];
  }

  line(points: number[], colour: string, width: number, alpha = 1) {
    const { context } = this;
    context.strokeStyle = colour;
    context.lineWidth = width * this.scale;
    context.globalAlpha = alpha;
    context.beginPath();
    for (let i = 0; i + 1 < points.length; i += 2) context.lineTo(...this.at(points[i]!, points[i + 1]!));
    context.stroke();
    context.globalAlpha = 1;
  }

  dot(x_m: number, y_m: number, colour: string) {
    this.context.fillStyle = colour;
    this.context.beginPath();
    this.context.arc(...this.at(x_m, y_m), 5 * this.scale, 0, 2 * Math.PI);
    this.context.fill();
  }
}
