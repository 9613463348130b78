/** What the browser keeps between visits. A browser may refuse; the page then works without. */

export function recall(key: string): string | null {
  try {
    return localStorage.getItem(`jred-${key}`);
  } catch {
    return null;
  }
}

/** Whether the browser has kept the value. */
export function keep(key: string, value: string): boolean {
  try {
    localStorage.setItem(`jred-${key}`, value);
    return true;
  } catch {
    return false;
  }
}
