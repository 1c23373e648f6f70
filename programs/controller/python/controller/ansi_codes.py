# SPDX-License-Identifier: MIT
"""AnsiCodes: colours for the console."""


def _colour(first):
    return ["\033[%dm" % code for code in range(first, first + 8)]


class AnsiCodes:
    """Words of ECMA-48 to print before and after a text: `print(AnsiCodes.RED_FOREGROUND + "hot" + AnsiCodes.RESET)`."""

    RESET, BOLD, UNDERLINE = "\033[0m", "\033[1m", "\033[4m"
    (BLACK_FOREGROUND, RED_FOREGROUND, GREEN_FOREGROUND, YELLOW_FOREGROUND,
     BLUE_FOREGROUND, MAGENTA_FOREGROUND, CYAN_FOREGROUND, WHITE_FOREGROUND) = _colour(30)
    (BLACK_BACKGROUND, RED_BACKGROUND, GREEN_BACKGROUND, YELLOW_BACKGROUND,
     BLUE_BACKGROUND, MAGENTA_BACKGROUND, CYAN_BACKGROUND, WHITE_BACKGROUND) = _colour(40)
    CLEAR_SCREEN = "\033[2J"
