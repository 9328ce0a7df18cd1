"""The models that a scene may need, one file each; `MODELS` has them in the order in which they are tried."""

from .chosen import Chosen
from .general import General
from .model import Model, State
from .moving import Moving
from .rolling import Rolling
from .steady import Steady
from .top import Top
from .vertical import Vertical

#: Of those that do not refuse, the cheapest is taken; of two of one price the first.
MODELS: tuple[Model, ...] = (Chosen(), Moving(), General(), Steady(), Top(), Vertical(), Rolling())

__all__ = ["MODELS", "Chosen", "General", "Model", "Moving", "Rolling", "State", "Steady", "Top", "Vertical"]
