// SPDX-License-Identifier: MIT
// Colours of paths and lines.
// Okabe and Ito: told apart by the colour-blind, too
export const kPalette = ["#0072b2", "#e69f00", "#009e73", "#d55e00", "#cc79a7", "#56b4e9", "#f0e442", "#7f7f7f"];
