// SPDX-License-Identifier: MIT
// A class as a table, student x exercise: text, CSV, HTML, JUnit XML. Nothing in it depends on the PC or on
// how many processes there were.
#pragma once
#include <string>

#include "exercises/class.h"

namespace lab {

/// The text's first line and its rows, aligned.
std::string class_header(const Class& all, std::size_t name_width);
std::string class_row(const Class& all, const Student& student, std::size_t name_width);
/// What each exercise asks, and each failure with the command that shows it.
std::string class_notes(const Class& all);

/// "student,I1,S2,...,passed,judged": a row a student.
std::string class_csv(const Class& all);
/// Every run's measures, with the student before them.
std::string class_runs_csv(const Class& all);
/// One page that needs nothing else.
std::string class_html(const Class& all, const std::string& title);
/// A test suite a student, a test case an exercise. What is missing is skipped; what does
/// not build is an error.
std::string class_junit(const Class& all);

/// Exercises that a student passed, and those that had a verdict: pass or FAIL, or no program.
struct Points {
  int passed = 0, judged = 0;
};
Points points_of(const Student& student);

}  // namespace lab
