#pragma once
#include <string>
#include "hal_sim/twin/twin.h"
#include "programs/link/packet.h"
#include "sim_core/record/picture.h"
namespace programs {
class SupervisorHost {
 public:
  virtual ~SupervisorHost() = default;
  virtual twin::Twin& twin() = 0;
  virtual void end_run(int status, const std::string& why) = 0;
  virtual void reset(bool reload) = 0;
  virtual void restart_program(int robot) = 0;
  virtual void set_label(int program, const sim::PictureLabel&) = 0;
  virtual void picture(const std::string& file) = 0;
  virtual void warn(int program, const std::string& text) = 0;
  virtual void note_custom_data(int robot, const std::string& text) = 0;
  virtual void note_move(int robot) = 0;
};
class Nodes {
 public:
  explicit Nodes(SupervisorHost& host) : host_(host) {}
  void answer(const link_record& question, int program, int robot, link_packet& answer) { link_begin(&answer, LINK_NOTHING); link_text(&answer,"none"); link_end(&answer);}
  void carry_out(const link_record& command, int program, int robot) {}
  void set_custom_data(int robot, const std::string&){}
  std::string custom_data(int) { return ""; }
  void put_back() {}
  SupervisorHost& host_;
};
}
