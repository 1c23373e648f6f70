// SPDX-License-Identifier: MIT
// From one instruction of a stretch to the next one, and out of it.
#include "dspic30/translate/maker.h"

namespace dspic::translate {

// `block`, which has no end yet, goes where `next` says
void Maker::leave(const Item& item, BasicBlock* block, Value* next) {
  // One place: an edge leads there.
  const int frame = item.callee ? item.callee : item.frame;
  bool arrives = false;
  if (place_of(next, arrives)) {
    BranchInst::Create(edge(item, next, frame), block);
    return;
  }
  // A choice of places, such as a branch makes: each of them gets its own edge.
  auto* const phi = dyn_cast<PHINode>(next->stripPointerCasts());
  const auto is_bare = [&] {
    return std::all_of(block->begin(), block->end(), [&](Instruction& i) {
      return &i == phi || (isa<BitCastInst>(i) && i.getOperand(0) == phi);
    });
  };
  if (phi && phi->getParent() == block && is_bare()) {
    std::vector<std::pair<BasicBlock*, Value*>> ways;
    for (unsigned i = 0; i < phi->getNumIncomingValues(); ++i)
      ways.emplace_back(phi->getIncomingBlock(i), phi->getIncomingValue(i));
    for (const auto& [from, value] : ways) {
      Instruction* const end = from->getTerminator();
      if (end->getNumSuccessors() == 1) {
        end->eraseFromParent();
        leave(item, from, value);
      } else {
        end->replaceSuccessorWith(block, edge(item, value, frame));
      }
    }
    block->dropAllReferences();
    block->eraseFromParent();
    return;
  }
  // behind a REPEAT, or a function that was called, the next one is likely
  const Row& row = *find_row(item.word);
  const bool repeats = row.id == Insn::Repeat_lit14 || row.id == Insn::Repeat_Wn;
  ir_.SetInsertPoint(block);
  Value* const likely = place(item.place + item.words + repeats);
  Value* const same = ir_.CreateICmpEQ(ir_.CreateBitCast(next, likely->getType()), likely);
  Instruction* const end = ir_.CreateCondBr(same, exit_, exit_);
  end->setSuccessor(0, edge(item, likely, frame));
  end->setSuccessor(1, edge(item, next, frame));
}

// on behind the call, if that is where the stack leads
void Maker::leave_by_return(const Item& item, BasicBlock* block) {
  BasicBlock* const out = passed(item);
  ir_.SetInsertPoint(out);
  ir_.CreateStore(place(item.place), field(&cpu_.at, byte_->getPointerTo()));
  ir_.CreateBr(ways_[2].block);
  ways_[2].where->addIncoming(return_address_, out);
  if (item.caller < 0) {
    BranchInst::Create(out, block);
    return;
  }
  const Item& caller = items_[static_cast<std::size_t>(item.caller)];
  BasicBlock* const back = BasicBlock::Create(context_, "", function_);
  ir_.SetInsertPoint(back);
  Value* const where = jump_to(caller.place + caller.words, caller.frame);
  BranchInst::Create(edge(item, where, caller.frame), back);
  ir_.SetInsertPoint(block);
  Value* const expected = ir_.CreateLoad(ir_.getInt32Ty(), backs_[static_cast<std::size_t>(item.frame)]);
  ir_.CreateCondBr(ir_.CreateICmpEQ(return_address_, expected), back, out);
}

// the answer of the routine that is called, or else a jump there
void Maker::leave_by_answer(const Item& item, BasicBlock* block) {
  BasicBlock* const done = BasicBlock::Create(context_, "", function_);
  BasicBlock* const out = passed(item);
  ir_.SetInsertPoint(out);
  ir_.CreateBr(ways_[0].block);
  ways_[0].where->addIncoming(ir_.getInt32(static_cast<std::uint32_t>(item.target)), out);
  ir_.SetInsertPoint(block);
  Value* const now = field(&cpu_.now, long_);
  Value* const begin =
      ir_.CreateAdd(ir_.CreateLoad(long_, now), ir_.getInt64(item.decoded.cycles + item.way));
  FunctionType* const no_type = FunctionType::get(ir_.getVoidTy(), false);
  Value* const routine = ir_.CreateBitCast(
      semantics_.module->getOrInsertFunction(known_routine(index_of(item)), no_type).getCallee(),
      byte_->getPointerTo());
  const std::array<Value*, 4> arguments = {cpu_arg_, place(item.routine_place), routine, begin};
  FunctionType* const type = FunctionType::get(
      long_, {arguments[0]->getType(), arguments[1]->getType(), arguments[2]->getType(), long_}, false);
  CallInst* const cycles = ir_.CreateCall(semantics_.module->getOrInsertFunction(kAnswered, type), arguments);
  effects_.push_back({cycles, &item, Effect::Routine});
  ir_.CreateCondBr(ir_.CreateICmpEQ(cycles, ir_.getInt64(0)), out, done);
  // behind its RETURN
  ir_.SetInsertPoint(done);
  ir_.CreateStore(ir_.CreateAdd(ir_.CreateLoad(long_, now), ir_.CreateAdd(cycles, ir_.getInt64(item.way))),
                  now);
  Value* const where = jump_to(item.place + item.words, item.frame);
  takes_long_ = true;
  BranchInst::Create(edge(item, where, item.frame), done);
  takes_long_ = false;
}

// a block in which the instruction's time passes
BasicBlock* Maker::passed(const Item& item) {
  BasicBlock* const begin = BasicBlock::Create(context_, "", function_);
  ir_.SetInsertPoint(begin);
  Value* const now = field(&cpu_.now, long_);
  ir_.CreateStore(ir_.CreateAdd(ir_.CreateLoad(long_, now), ir_.getInt64(item.decoded.cycles)), now);
  return begin;
}

// the instruction's time passes; then the next one, unless something may happen before it
BasicBlock* Maker::edge(const Item& item, Value* next, int frame) {
  BasicBlock* const begin = passed(item);
  // It leaves the stretch, by a way that is known or by a pointer.
  bool arrives = false;
  const Optional<std::ptrdiff_t> to = place_of(next, arrives);
  if (to && (arrives || (frame == 0 && *to == end_))) {
    const Way& way = ways_[arrives ? 0 : 1];
    ir_.CreateBr(way.block);
    way.where->addIncoming(ir_.getInt32(static_cast<std::uint32_t>(*to)), begin);
    return begin;
  }
  const Item* const target = to ? find(*to, frame) : nullptr;
  Value* const pointer = to ? place(*to) : ir_.CreateBitCast(next, byte_->getPointerTo());
  if (!target) {
    ir_.CreateBr(exit_);
    exit_at_->addIncoming(pointer, begin);
    return begin;
  }
  // It stays within. Time is checked where a section begins, and behind what may have lowered the deadline.
  BasicBlock* const first = blocks_[index_of(*target)];
  const bool is_back = target <= &item;
  const bool begins_section =
      is_back || takes_long_ || sections_[index_of(*target)] != sections_[index_of(item)];
  if (!begins_section && !may_leave_) {
    ir_.CreateBr(first);
    return begin;
  }
  BasicBlock* const check = BasicBlock::Create(context_, "", function_);
  if (begins_section)
    ir_.CreateBr(check);
  else
    ir_.CreateCondBr(ir_.CreateLoad(ir_.getInt1Ty(), left_), check, first);
  ir_.SetInsertPoint(check);
  ir_.CreateStore(ir_.getFalse(), left_);
  // what comes there again and again may begin there
  const bool is_entry = !is_back && frame == 0;
  Value* const exit_pointer = place(*to);
  ir_.CreateCondBr(may_loop_ ? fits(*target) : is_in_time(*target), first, is_entry ? ways_[1].block : exit_);
  if (is_entry)
    ways_[1].where->addIncoming(ir_.getInt32(static_cast<std::uint32_t>(*to)), check);
  else
    exit_at_->addIncoming(exit_pointer, check);
  return begin;
}

}  // namespace dspic::translate
