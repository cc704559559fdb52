import type { Pose } from "./contract";

const kMostPoints = 1500;

/** Where the robot has been: x and y in turn, m. When it is full, every second point goes, so that it stays small however long the robot drives. */
export class Trail {
  points: number[] = [];
  pose: Pose | null = null;
  private apart_m = 0.002;

  move(pose: Pose) {
    this.pose = pose;
    const [x, y] = this.points.slice(-2);
    if (x !== undefined && Math.hypot(pose.x_m - x, pose.y_m - y!) < this.apart_m) return;
    this.points.push(pose.x_m, pose.y_m);
    if (this.points.length <= 2 * kMostPoints) return;
    this.points = this.points.filter((_, i) => i % 4 < 2);
    this.apart_m *= 2;
  }

  clear() {
    this.points = [];
    this.apart_m = 0.002;
    if (this.pose) this.move(this.pose);
  }
}
