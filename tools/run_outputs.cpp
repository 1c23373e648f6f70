#include "tools/run_outputs.h"
#include <fstream>
namespace sim { class CsvRecorder{}; class PathLog{}; }
namespace tools {
void add_output_options(CLI::App& v, OutputArguments& a){ v.add_option("--summary", a.summary); v.add_option("--coverage", a.coverage);}
RunOutputs::RunOutputs(const OutputArguments& a, twin::Twin& t):arguments_(a),twin_(t){}
RunOutputs::~RunOutputs()=default;
bool RunOutputs::open(std::vector<std::string>&){return true;}
void RunOutputs::before_run(){} void RunOutputs::after_tick(){} bool RunOutputs::failed() const {return false;}
void RunOutputs::finish(const Summary& s, std::vector<std::string>&){ if(!arguments_.summary.empty()) std::ofstream(arguments_.summary)<<to_json(s);}
}
