/** What is drawn before the browser shows its next picture, once, however often it changes until then. */
export class Frames {
  private draws = new Set<() => void>();
  private writes = new Set<() => void>();
  private due = 0;

  /** Answers how to end it. `draw` may ask for sizes, and `write` changes the document, after which asking is expensive. */
  add(draw: () => void, write: () => void): () => void {
    this.draws.add(draw);
    this.writes.add(write);
    return () => {
      this.draws.delete(draw);
      this.writes.delete(write);
    };
  }

  request() {
    this.due ||= requestAnimationFrame(() => {
      this.due = 0;
      for (const draw of this.draws) draw();
      for (const write of this.writes) write();
    });
  }
}
