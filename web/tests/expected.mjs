// What native builds have left in hashes.json: for each name how many steps were taken, and the hash after them.

/** How many steps lead to an expected state. */
export const stepsOf = (expected) => Number(expected.split(" ")[0]);
