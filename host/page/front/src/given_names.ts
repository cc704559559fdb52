/** "odom.csv.gz" and 2 make "odom (2).csv.gz". */
const numbered = (name: string, number: number) => (number === 1 ? name : name.replace(/((\.[a-z0-9]+)?(\.gz)?)$/i, ` (${number})$1`));

/**
 * The names under which a person's files are known. Files of several folders often have the same name, so a second one gets a
 * number; but the same file again keeps its name.
 */
export class GivenNames {
  private readonly files = new Map<string, string>();

  give(file: File): File {
    const which = `${file.name} ${file.size} ${file.lastModified}`;
    for (let number = 1; ; ++number) {
      const name = numbered(file.name, number);
      const there = this.files.get(name);
      if (there !== undefined && there !== which) continue;
      this.files.set(name, which);
      return name === file.name ? file : new File([file], name, { lastModified: file.lastModified });
    }
  }

  forget(name: string) {
    this.files.delete(name);
  }
}
