// SPDX-License-Identifier: MIT
#include "dspic30/translate/region.h"

#include <llvm/Analysis/InstructionSimplify.h>
#include <llvm/Transforms/Utils/BasicBlockUtils.h>
#include <llvm/Transforms/Utils/Cloning.h>
#include <llvm/Transforms/Utils/Local.h>

#include <cstring>

#include "dspic30/translate/maker.h"

namespace dspic::translate {

namespace {

// most cycles between two looks at the time: what is left of them before something happens is interpreted
constexpr int kSection = 48;
constexpr std::ptrdiff_t kGap = 16;  // words that were not met, within a piece

}  // namespace

Maker::Maker(Semantics& semantics, const Cpu& cpu, const std::vector<Item>& items, const std::string& name)
    : semantics_(semantics),
      cpu_(cpu),
      items_(items),
      context_(semantics.module->getContext()),
      layout_(semantics.module->getDataLayout()),
      ir_(context_),
      byte_(Type::getInt8Ty(context_)),
      long_(Type::getInt64Ty(context_)) {
  Type* const pointer = byte_->getPointerTo();
  function_ = Function::Create(FunctionType::get(pointer, {pointer, pointer}, false),
                               GlobalValue::ExternalLinkage, name, *semantics.module);
  function_->setDoesNotThrow();
  cpu_arg_ = function_->getArg(0);
  head_arg_ = function_->getArg(1);
  int cycles = 0;
  for (const Item& item : items_) {
    cycles += item.most_cycles;
    const bool is_new = !sections_.empty() && cycles > kSection;
    if (is_new) cycles = item.most_cycles;
    sections_.push_back(sections_.empty() ? 0 : sections_.back() + is_new);
    index_[{item.frame, item.place}] = blocks_.size();
    if (item.frame == 0) end_ = item.place + item.words;
    blocks_.push_back(BasicBlock::Create(context_));
  }
  for (const Item& item : items_) {
    const std::ptrdiff_t end = item.place + item.words;
    const auto goes_on = std::find_if(pieces_.begin(), pieces_.end(), [&](const auto& piece) {
      return item.place >= piece.first && item.place <= piece.second + kGap;
    });
    std::pair<std::ptrdiff_t, std::ptrdiff_t> piece{item.place, end};
    if (goes_on != pieces_.end()) {
      piece = {goes_on->first, std::max(goes_on->second, end)};
      pieces_.erase(goes_on);
    }
    pieces_.insert(piece);
  }
  exit_ = BasicBlock::Create(context_, "exit");
  exit_at_ = PHINode::Create(pointer, 8, "", exit_);
  for (std::size_t i = 0; i < ways_.size(); ++i) {
    BasicBlock* const block = BasicBlock::Create(context_);
    ways_[i] = {i == 0   ? kArrive
                : i == 1 ? kGoOn
                         : kReturn,
                block, PHINode::Create(ir_.getInt32Ty(), 8, "", block)};
  }
}

std::unique_ptr<Module> Maker::make() {
  // The entry, each instruction, and the ways out, in one function.
  put_entry();
  for (const Item& item : items_)
    if (!put_item(item)) return nullptr;
  for (BasicBlock* block : exits()) function_->getBasicBlockList().push_back(block);
  for (const Aside& aside : asides_) function_->getBasicBlockList().push_back(aside.block);
  // whoever called counts the head's cycles
  const auto pass = [&](int cycles) {
    Value* const now = field(&cpu_.now, long_);
    ir_.CreateStore(ir_.CreateAdd(ir_.CreateLoad(long_, now), ir_.getInt64(cycles)), now);
  };
  // How each way ends.
  ir_.SetInsertPoint(exit_);
  ir_.CreateRet(exit_at_);
  for (const Way& way : ways_) {
    ir_.SetInsertPoint(way.block);
    ir_.CreateRet(called(way.name, {cpu_arg_, head_arg_, way.where}));
  }
  for (const Aside& aside : asides_) {
    ir_.SetInsertPoint(aside.block);
    ir_.CreateUnreachable();
  }
  // Now that it is complete, the state becomes the function's own.
  removeUnreachableBlocks(*function_);
  for (BasicBlock& block : *function_) live_.insert(&block);
  if (!keep_state()) return nullptr;
  for (BasicBlock* block : exits()) {
    if (!live_.count(block)) continue;
    ir_.SetInsertPoint(&*std::find_if(block->begin(), block->end(), [](const Instruction& i) {
      return i.isTerminator() || is_real_call(i);
    }));
    pass(-items_[0].decoded.cycles);
  }
  // An instruction that is run aside runs alone, with the Cpu as it is where it begins.
  for (const Aside& aside : asides_) {
    if (!live_.count(aside.block)) continue;
    Instruction* const end = aside.block->getTerminator();
    ir_.SetInsertPoint(end);
    Value* const d = place(aside.item->place);
    ir_.CreateStore(d, field(&cpu_.at, byte_->getPointerTo()));
    CallInst* const next = called(aside.item->is_told ? kAlone : alone(*aside.item), {cpu_arg_, d});
    pass(aside.item->decoded.cycles - items_[0].decoded.cycles);
    ir_.CreateRet(next);
    end->eraseFromParent();
  }
  optimise();
  return moved_out();
}

void Maker::put_entry() {
  BasicBlock* const entry = BasicBlock::Create(context_, "entry", function_);
  BasicBlock* const plain = BasicBlock::Create(context_, "plain", function_);
  ir_.SetInsertPoint(entry);
  left_ = ir_.CreateAlloca(ir_.getInt1Ty());
  ir_.CreateStore(ir_.getFalse(), left_);
  for (const Item& item : items_) {
    const auto frames = static_cast<std::size_t>(std::max(item.frame, item.callee)) + 1;
    while (backs_.size() < frames) backs_.push_back(ir_.CreateAlloca(ir_.getInt32Ty()));
  }
  ir_.CreateCondBr(fits(items_[0]), blocks_[0], plain);
  ir_.SetInsertPoint(plain);
  ir_.CreateRet(called(alone(items_[0]), {cpu_arg_, head_arg_}));
}

// --- an instruction

bool Maker::put_item(const Item& item) {
  BasicBlock* const first = blocks_[index_of(item)];
  function_->getBasicBlockList().push_back(first);
  ir_.SetInsertPoint(first);
  if (item.is_last) {
    ir_.CreateBr(aside(item, first));
    return true;
  }
  // It is a call of the instruction's function, inlined, or of something that does the same.
  Value* const d = place(item.place);
  Function* const own = item.is_host ? nullptr : semantics_.of(item.word);
  CallInst* call;
  if (item.is_told && own) called(kHeard, {cpu_arg_, d});
  if (own) {
    const FunctionType* const type = own->getFunctionType();
    call = ir_.CreateCall(own, {ir_.CreateBitCast(cpu_arg_, type->getParamType(0)),
                                ir_.CreateBitCast(d, type->getParamType(1))});
  } else {  // not by Decoded::run, which at the head is this very stretch
    call = called(item.is_host ? kHost : item.is_told ? kTold : kAlone, {cpu_arg_, d});
  }
  ir_.CreateRet(ir_.CreateBitCast(call, byte_->getPointerTo()));
  // What is known of its operands makes it small.
  if (own) {
    if (!inlined(call)) return false;
    fold(item, first);
    keep_jumps(item, first);
    put_costs(item, first);
    take_saved(first);
  }
  // Where it goes from here.
  find_effects(item, first);
  for (BasicBlock* block : blocks_from(first)) {
    auto* const back = dyn_cast<ReturnInst>(block->getTerminator());
    if (!back) continue;
    Value* const next = back->getReturnValue();
    back->eraseFromParent();
    if (item.returns && own)
      leave_by_return(item, block);
    else if (item.routine)
      leave_by_answer(item, block);
    else
      leave(item, block, next);
    break;
  }
  return true;
}

BasicBlock* Maker::aside(const Item& item, BasicBlock* first) {
  if (asides_.empty() || asides_.back().item != &item)
    asides_.push_back({&item, first, BasicBlock::Create(context_)});
  return asides_.back().block;
}

// with all that it calls, as far as that is bitcode; but not jumps
bool Maker::inlined(CallInst* call) {
  SmallVector<CallBase*, 8> work{call};
  while (!work.empty()) {
    CallBase* const c = work.pop_back_val();
    Function* const callee = c->getCalledFunction();
    if (!callee || callee->isIntrinsic() || (is_jump(callee->getName()) && c != call)) continue;
    if (callee->isMaterializable() && callee->materialize()) return false;
    if (callee->isDeclaration()) continue;
    InlineFunctionInfo info;
    if (!InlineFunction(*c, info).isSuccess()) return false;
    work.append(info.InlinedCallSites.begin(), info.InlinedCallSites.end());
  }
  return true;
}

std::vector<BasicBlock*> Maker::blocks_from(BasicBlock* first) {
  std::vector<BasicBlock*> all;
  for (auto block = first->getIterator(); block != function_->end(); ++block) all.push_back(&*block);
  return all;
}

// what the Decoded says is known, and so is where plain RAM begins
void Maker::fold(const Item& item, BasicBlock* first) {
  const auto* const bytes = reinterpret_cast<const unsigned char*>(&item.decoded);
  const auto known = [&](const Instruction& i) -> Constant* {
    const auto* const load = dyn_cast<LoadInst>(&i);
    if (!load || !load->getType()->isIntegerTy()) return nullptr;
    const auto [base, all] = split(const_cast<Value*>(load->getPointerOperand()));
    if (base == cpu_arg_ && static_cast<std::uint64_t>(all) == offset_of(cpu_, &cpu_.plain_start))
      return ConstantInt::get(load->getType(), cpu_.plain_start);
    const std::int64_t offset = all - item.place * static_cast<std::int64_t>(sizeof(Decoded));
    const std::uint64_t size = layout_.getTypeStoreSize(load->getType());
    if (base != head_arg_ || offset < 8 || offset + size > sizeof(Decoded)) return nullptr;
    std::uint64_t value = 0;
    std::memcpy(&value, bytes + offset, size);
    return ConstantInt::get(load->getType(), value);
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (BasicBlock* block : blocks_from(first)) {
      for (Instruction& i : make_early_inc_range(*block)) {
        Value* value = known(i);
        if (!value) value = SimplifyInstruction(&i, {layout_});
        if (value && value != &i && !i.use_empty()) i.replaceAllUsesWith(value);
        if (isInstructionTriviallyDead(&i)) i.eraseFromParent();
      }
      changed |= ConstantFoldTerminator(block, true);
    }
    drop_dead(first);
    for (BasicBlock* block : blocks_from(first))
      if (block != first) MergeBlockIntoPredecessor(block);
  }
}

void Maker::drop_dead(BasicBlock* first) {
  SmallPtrSet<BasicBlock*, 16> live{first};
  SmallVector<BasicBlock*, 16> work{first}, dead;
  while (!work.empty())
    for (BasicBlock* next : successors(work.pop_back_val()))
      if (live.insert(next).second) work.push_back(next);
  for (BasicBlock* block : blocks_from(first))
    if (!live.count(block)) dead.push_back(block);
  DeleteDeadBlocks(dead);
}

// a jump within the stretch is no call; one out of it is made at the end
void Maker::keep_jumps(const Item& item, BasicBlock* first) {
  std::vector<CallInst*> jumps;
  for (BasicBlock* block : blocks_from(first))
    for (Instruction& i : *block)
      if (auto* const call = dyn_cast<CallInst>(&i); call && is_jump(name_of(*call))) jumps.push_back(call);
  for (CallInst* jump : jumps) {
    ir_.SetInsertPoint(jump);
    Value* where = place(item.place);
    if (name_of(*jump) == kReturnTo) {
      return_address_ = jump->getArgOperand(1);
    } else if (!item.routine) {
      if (item.callee) ir_.CreateStore(jump->getArgOperand(3), backs_[static_cast<std::size_t>(item.callee)]);
      const bool is_near = name_of(*jump) == kOffset;
      const std::ptrdiff_t to =
          is_near ? item.place + cast<ConstantInt>(jump->getArgOperand(2))->getSExtValue() : item.target;
      where = jump_to(to, item.callee ? item.callee : item.frame);
    }
    jump->replaceAllUsesWith(ir_.CreateBitCast(where, jump->getType()));
    jump->eraseFromParent();
  }
}

// as Cpu::arrive(), unless it leads out of the stretch
Value* Maker::jump_to(std::ptrdiff_t to, int frame) {
  const Item* const target = find(to, frame);
  if (!target) return ir_.CreateConstInBoundsGEP1_64(byte_, place(to), 1);
  if (const int lead = target->decoded.lead) {
    Value* const now = field(&cpu_.now, long_);
    ir_.CreateStore(ir_.CreateSub(ir_.CreateLoad(long_, now), ir_.getInt64(lead)), now);
  }
  return place(to);
}

// of a read through the PSV window
void Maker::put_costs(const Item& item, BasicBlock* first) {
  for (BasicBlock* block : blocks_from(first))
    for (Instruction& i : make_early_inc_range(*block)) {
      auto* const call = dyn_cast<CallInst>(&i);
      if (!call || name_of(*call) != kPsvCost) continue;
      call->replaceAllUsesWith(ConstantInt::get(call->getType(), item.decoded.psv));
      call->eraseFromParent();
    }
}

// what handlers save and give back is read and written here
void Maker::take_saved(BasicBlock* first) {
  for (BasicBlock* block : blocks_from(first))
    for (Instruction& i : make_early_inc_range(*block)) {
      auto* const call = dyn_cast<CallInst>(&i);
      const ConstantInt* const address = call ? address_in(*call) : nullptr;
      const Cpu::Saved saved =
          address ? Cpu::saved_register(static_cast<unsigned>(address->getZExtValue())) : Cpu::Saved{};
      if (!saved.word || name_of(*call) == kModify) continue;
      const bool reads = name_of(*call) == kRead;
      const auto* const bits = dyn_cast<ConstantInt>(call->getArgOperand(reads ? 2 : 3));
      if (!bits || bits->getZExtValue() != 16) continue;
      ir_.SetInsertPoint(call);
      Type* const word = ir_.getInt16Ty();
      Value* const place = field(&(cpu_.*saved.word), word);
      if (reads)
        call->replaceAllUsesWith(ir_.CreateZExt(ir_.CreateLoad(word, place), call->getType()));
      else
        put_saved(saved, ir_.CreateTrunc(ir_.CreateAnd(call->getArgOperand(2), saved.bits), word));
      call->eraseFromParent();
    }
}

// another page is another window
void Maker::put_saved(const Cpu::Saved& saved, Value* value) {
  Value* const place = field(&(cpu_.*saved.word), value->getType());
  if (saved.word == &Cpu::psvpag) {
    PointerType* const pointer = byte_->getPointerTo();
    Value* const words = field(&cpu_.window_words, pointer);
    Value* const stays = ir_.CreateICmpEQ(ir_.CreateLoad(value->getType(), place), value);
    ir_.CreateStore(
        ir_.CreateSelect(stays, ir_.CreateLoad(pointer, words), ConstantPointerNull::get(pointer)), words);
  }
  ir_.CreateStore(value, place);
}

// What leaves RAM leaves the stretch: the instruction is run anew, aside. But where an instruction names its
// register, or calls something else, that is called from here.
void Maker::find_effects(const Item& item, BasicBlock* first) {
  may_leave_ = may_loop_ = false;
  std::vector<CallInst*> beyond;
  bool others = false;
  const auto deadline = static_cast<std::int64_t>(offset_of(cpu_, &cpu_.deadline));
  // Each call, and each store that lowers the deadline, has an effect beyond the function.
  for (BasicBlock* block : blocks_from(first))
    for (Instruction& i : *block) {
      if (is_real_call(i)) {
        auto* const call = cast<CallInst>(&i);
        if (name_of(*call) == kServed || name_of(*call) == kHeard) {
          effects_.push_back({call, &item, name_of(*call) == kServed ? Effect::Look : Effect::LookAtCall});
          continue;
        }
        if (is_beyond_ram(*call))
          beyond.push_back(call);
        else
          others = true;
        effects_.push_back({call, &item,
                            item.is_host              ? Effect::HostCall
                            : is_of_peripheral(*call) ? Effect::ClockOnly
                                                      : Effect::All});
        may_leave_ = true;
        may_loop_ |= effects_.back().is_any();
      } else if (isa<StoreInst>(i) && split(i.getOperand(1)) == std::make_pair(cpu_arg_, deadline)) {
        effects_.push_back({&i, &item, Effect::All});
        may_leave_ = may_loop_ = true;
      }
    }
  // Where nothing but accesses beyond RAM remain, they lead aside.
  if (others || beyond.empty()) return;
  for (CallInst* call : beyond) {
    BasicBlock* const block = call->getParent();
    block->splitBasicBlock(call);
    block->getTerminator()->setSuccessor(0, aside(item, first));
  }
  drop_dead(first);
  may_leave_ = may_loop_ = false;
}

std::unique_ptr<Module> translate(Semantics& semantics, const Cpu& cpu, const std::vector<Item>& items,
                                  const std::string& name) {
  return Maker(semantics, cpu, items, name).make();
}

}  // namespace dspic::translate
