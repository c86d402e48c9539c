"""Cases in which any two values of any two factors meet at least once, far fewer than all combinations."""
import itertools


def covering(factors):
    """factors: lists of values by name. Dictionaries with a value for each name, in an order that is the same in every run. Each case
    takes a pair that has not met, and then for every other factor the value that meets most others for the first time."""
    names = list(factors)
    open_pairs = dict.fromkeys(frozenset(((a, i), (b, k))) for a, b in itertools.combinations(names, 2)
                               for i in range(len(factors[a])) for k in range(len(factors[b])))
    while open_pairs:
        case = dict(next(iter(open_pairs)))
        for name in names:
            if name not in case:
                case[name] = max(range(len(factors[name])), key=lambda i, name=name: sum(
                    frozenset(((name, i), other)) in open_pairs for other in case.items()))
        for pair in itertools.combinations(case.items(), 2):
            open_pairs.pop(frozenset(pair), None)
        yield {name: factors[name][case[name]] for name in names}
